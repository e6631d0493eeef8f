// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "cairn/builder/simplify.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <vector>

#include "cairn/builder/import.h"
#include "import/one_line.h"
#include "import/surface_mesh.h"

namespace cairn::builder {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Called before every collapse. It ends the collapses at a number of edges, or when the user cancels.
class Stop {
 public:
  Stop(std::size_t edges, const ProgressCallback& progress, bool& cancelled)
      : edges_(edges), progress_(progress), cancelled_(cancelled) {}

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t initial, std::size_t current) const {
    if (current < edges_) return true;
    constexpr std::size_t kCallsPerReport = 256;
    if (progress_ && calls_++ % kCallsPerReport == 0) {
      const double done = static_cast<double>(initial - current) / static_cast<double>(initial);
      cancelled_ = !progress_("collapsing edges", done);
    }
    return cancelled_;
  }

 private:
  std::size_t edges_;
  const ProgressCallback& progress_;
  bool& cancelled_;
  mutable std::size_t calls_ = 0;
};

/// False when cancelled.
bool collapse(Surface& surface, std::uint32_t triangles, const ProgressCallback& progress) {
  bool cancelled = false;
  // Every edge of a closed mesh has two triangles, every triangle three edges.
  const Stop stop(std::size_t{triangles} / 2 * 3 + 1, progress, cancelled);
  const sms::Bounded_normal_change_placement<sms::LindstromTurk_placement<Surface>> placement;
  sms::edge_collapse(surface, stop, CGAL::parameters::get_placement(placement));
  return !cancelled;
}

}  // namespace

Result<TriangleMesh> simplify(const TriangleMesh& mesh, std::uint32_t triangles, const ProgressCallback& progress) try {
  if (mesh.triangles.size() <= triangles) return mesh;
  Surface surface = surfaceFrom<Kernel::Point_3>(mesh);
  if (surface.is_empty())
    return Error{"the mesh has a vertex where two surfaces only touch, which cannot be simplified; separate it"};
  if (!collapse(surface, triangles, progress)) return Error{std::string(kCancelled)};
  TriangleMesh simple = meshFrom(surface);
  simple.name = mesh.name;
  if (simple.triangles.size() > triangles)
    return Error{fmt::format("the mesh could only be simplified to {} triangles, not to {}; ask for more",
                             simple.triangles.size(), triangles)};
  if (progress && !progress("checking", 1)) return Error{std::string(kCancelled)};
  if (!checkMesh(simple))
    return Error{
        fmt::format("with no more than {} triangles the surface would cut through itself; ask for more", triangles)};
  return simple;
} catch (const std::exception& e) {
  return Error{fmt::format("the mesh could not be simplified ({}); repair the mesh", oneLine(e.what()))};
}

std::string objText(const TriangleMesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Vec3d& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x, v.y, v.z);
  for (const Triangle& t : mesh.triangles) fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

}  // namespace cairn::builder
