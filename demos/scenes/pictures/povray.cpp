// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/povray.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "scenes/command/subprocess.h"

namespace cairn::scenes {
namespace {

namespace fs = std::filesystem;

/// cos(55 degrees): faces that meet at less are shaded as one smooth surface.
constexpr double kCreaseCosine = 0.574;

/// A temporary folder for one rendering, removed with its contents.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "cairn-picture-XXXXXX").string();
    if (mkdtemp(name.data())) path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Twice the area of each face times its normal.
std::vector<Vec3d> areaNormals(std::span<const Vec3d> vertices,
                               std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Vec3d> normals;
  for (const auto& [a, b, c] : triangles)
    normals.push_back(cross(vertices[b] - vertices[a], vertices[c] - vertices[a]));
  return normals;
}

/// One normal for each corner of each triangle: the mean over the faces at that vertex which do not meet it at a
/// crease.
std::vector<Vec3d> cornerNormals(std::span<const Vec3d> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
  const std::vector<Vec3d> faceNormals = areaNormals(vertices, triangles);
  std::vector<std::vector<std::size_t>> facesAt(vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t corner : triangles[t]) facesAt[corner].push_back(t);
  std::vector<Vec3d> normals;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3d& own = faceNormals[t];
    for (const std::uint32_t corner : triangles[t]) {
      Vec3d sum{};
      for (const std::size_t f : facesAt[corner])
        if (dot(faceNormals[f], own) >= kCreaseCosine * length(faceNormals[f]) * length(own)) sum += faceNormals[f];
      normals.push_back(normalized(sum));
    }
  }
  return normals;
}

/// The line of POV-Ray's output that names the error.
std::string complaintIn(const fs::path& log) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);)
    if (line.find("rror:") != std::string::npos || line.find("ailed") != std::string::npos) return line;
  return "it does not say why";
}

}  // namespace

PictureSize scaledTo(const PictureSize& size, std::uint32_t width) {
  return {width, static_cast<std::uint32_t>(std::uint64_t{size.height} * width / size.width)};
}

std::string povrayVector(const Vec3d& v) {
  return fmt::format("<{:.6g},{:.6g},{:.6g}>", v.x, v.y, v.z);
}

std::string povrayMesh(const std::string& name, std::span<const Vec3d> vertices,
                       std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::string text = fmt::format("#declare {} = mesh2 {{\n", name);
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "vertex_vectors {{ {}", vertices.size());
  for (const Vec3d& v : vertices) fmt::format_to(out, ",{}", povrayVector(v));
  fmt::format_to(out, " }}\nnormal_vectors {{ {}", 3 * triangles.size());
  for (const Vec3d& n : cornerNormals(vertices, triangles)) fmt::format_to(out, ",{}", povrayVector(n));
  fmt::format_to(out, " }}\nface_indices {{ {}", triangles.size());
  for (const auto& [a, b, c] : triangles) fmt::format_to(out, ",<{},{},{}>", a, b, c);
  fmt::format_to(out, " }}\nnormal_indices {{ {}", triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) fmt::format_to(out, ",<{},{},{}>", 3 * t, 3 * t + 1, 3 * t + 2);
  fmt::format_to(out, " }}\n}}\n");
  return text;
}

Status renderWithPovray(const std::string& scene, const PictureSize& size, const std::filesystem::path& png) {
  const ScratchFolder scratch;
  if (scratch.path().empty())
    return Error{"cannot make a folder for the scene in " + fs::temp_directory_path().string()};
  if (const Status status = writeFileAtomically(scratch.path() / "scene.pov", scene); !status) return status;
  return writeFileAtomically(png, [&](const fs::path& temporary) -> Status {
    const fs::path log = scratch.path() / "povray.log";
    // POV-Ray splits its options at spaces and quotes and replaces characters outside ASCII. So it only gets these
    // names.
    const int code = runCommand({"povray", "+Iscene.pov", "+Opicture.png", fmt::format("+W{}", size.width),
                                 fmt::format("+H{}", size.height), "+A0.15", "+R3", "-D", "+FN"},
                                log, scratch.path());
    if (code == -ENOENT) return Error{"POV-Ray is needed to render pictures: install the package povray"};
    if (code != 0) return Error{fmt::format("povray could not render {}: {}", png.string(), complaintIn(log))};
    std::error_code failure;
    fs::copy_file(scratch.path() / "picture.png", temporary, failure);
    return failure ? Error{fmt::format("cannot write {}: {}", png.string(), failure.message())} : Status();
  });
}

}  // namespace cairn::scenes
