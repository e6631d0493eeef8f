// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <regex>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "mesh_texts.h"

// Files that lie about what they hold, one slip in each, anywhere:
//
//     v 0 0 0              v 0 0 0           OFF                 [header: 12 triangles]
//     v nan 0 0   <-       v inf 0 0  <-     8 12 0              [triangle 0]
//     f 1 2 9     <-       f 1 2 3           0 0 0  (end)  <-    [triangle 1, half of i
namespace cairn::hard {
namespace {

struct Format {
  const char* name;
  std::string (*bytes)(const builder::TriangleMesh&);
};
const std::array<Format, 7> kFormats{{{"mesh.obj", test::objText},
                                      {"mesh.off", test::offText},
                                      {"text.ply", test::plyText},
                                      {"double.ply", test::plyBinary},
                                      {"float.ply", builder::plyBytes},
                                      {"text.stl", test::stlText},
                                      {"binary.stl", test::stlBinary}}};

/// The messages for files that had to be refused.
struct Answers {
  std::uint64_t files = 0, accepted = 0, withoutPlace = 0;
  std::string first;

  void note(const std::string& name, const Result<builder::TriangleMesh>& result) {
    ++files;
    if (result) {
      ++accepted;
      return;
    }
    const std::string& message = result.error().message;
    // A line, an element, or how many there are; of a file that has none, that.
    static const std::regex place(
        R"(, line \d+: |(vertex|face|triangle) \d+|\d+ of \d+ |: \d+ bytes |: the file is empty|: it holds no triangles)");
    if (std::regex_search(message, place) && message.find(name) != std::string::npos &&
        message.find('\n') == std::string::npos)
      return;
    ++withoutPlace;
    if (first.empty()) first = message;
  }
};

Measure none(const char* name, std::uint64_t count, std::uint64_t all) {
  return {name, double(count), 0, Bound::atMost, "of " + std::to_string(all), "", 0};
}

class Breaker {
 public:
  Breaker(FamilyDemands& demands, Effort effort) : demands_(demands), effort_(effort) {}

  /// A coordinate that is NaN, and a triangle that names a vertex beyond the last: where a format has such.
  void spoilElements(const Format& format) {
    for (std::uint32_t v = 0; v < solid_.vertices.size(); v += effort_ == Effort::quick ? 3 : 1)
      for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
        builder::TriangleMesh mesh = solid_;
        mesh.vertices[v][int(v % 3)] = bad;
        elements.note(format.name, demands_.import(format.name, format.bytes(mesh)));
      }
    if (std::string(format.name).ends_with("stl")) return;
    for (std::uint32_t t = 0; t < solid_.triangles.size(); t += effort_ == Effort::quick ? 5 : 1)
      for (const std::uint32_t bad : {8U, 9U, 40000U}) {
        builder::TriangleMesh mesh = solid_;
        mesh.triangles[t][t % 3] = bad;
        elements.note(format.name, demands_.import(format.name, format.bytes(mesh)));
      }
  }

  /// A file that ends too early. What is left may be all that was asked for (a final newline is missing).
  void truncate(const Format& format) {
    const std::string bytes = format.bytes(solid_);
    const std::size_t step = effort_ == Effort::quick ? 23 : 1;
    for (std::size_t length = 0; length < bytes.size(); length += step) {
      const auto result = demands_.import(format.name, bytes.substr(0, length));
      if (!result || !isWhole(result.value())) truncations.note(format.name, result);
    }
  }

  Answers elements, truncations;

 private:
  /// Whether a mesh is the solid, corner by corner, as floats.
  bool isWhole(const builder::TriangleMesh& mesh) const {
    if (!builder::checkMesh(mesh) || mesh.triangles.size() != solid_.triangles.size()) return false;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        if (Vec3(mesh.corners(t)[i]) != Vec3(solid_.corners(t)[i])) return false;
    return true;
  }

  FamilyDemands& demands_;
  Effort effort_;
  const builder::TriangleMesh solid_ = test::meshOf(test::cuboid({1, 1, 1}, 1));
};

Outcome runBrokenFiles(Effort effort) {
  FamilyDemands demands(effort, 1);
  Breaker breaker(demands, effort);
  for (const Format& format : kFormats) {
    breaker.spoilElements(format);
    breaker.truncate(format);
  }
  const Answers &elements = breaker.elements, &truncations = breaker.truncations;
  Outcome outcome{{none("files with a bad element accepted", elements.accepted, elements.files),
                   none("of them refused without a place", elements.withoutPlace, elements.files),
                   none("truncated files accepted", truncations.accepted, truncations.files),
                   none("of them refused without a place", truncations.withoutPlace, truncations.files)},
                  elements.first.empty() ? truncations.first : elements.first};
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase brokenFiles() {
  return {"G11", "NaN, infinity, indices out of range, truncated files",
          "every file, of seven forms, with one such slip or cut after any byte is refused with file and line, element "
          "or count (proposed list); no read past the end: the same importer under ASan in the asan preset and in "
          "fuzzing",
          runBrokenFiles};
}

}  // namespace cairn::hard
