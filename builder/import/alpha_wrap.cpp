// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <fmt/format.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "import/one_line.h"
#include "import/surface_mesh.h"

namespace cairn::builder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::size_t kMaxVertices = 1'000'000;

struct Cancelled {};
struct TooFine {};

/// Follows the progress of the wrap. An exception is the only way out of CGAL's loop.
struct Watch : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
  explicit Watch(const ProgressCallback& callback) : progress(callback) {}

  template <class Wrapper, class Gate>
  void before_facet_treatment(const Wrapper& wrapper, const Gate&) {
    constexpr std::size_t kStepsPerReport = 512;
    if (steps++ % kStepsPerReport != 0) return;
    if (wrapper.triangulation().number_of_vertices() > kMaxVertices) throw TooFine{};
    // The amount of work is known only at the end.
    if (progress && !progress("wrapping", 0)) throw Cancelled{};
  }

  const ProgressCallback& progress;
  std::size_t steps = 0;
};

}  // namespace

Result<TriangleMesh> alphaWrap(const TriangleMesh& surface, double alpha, double offset,
                               const ProgressCallback& progress) try {
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& v : surface.vertices) points.emplace_back(v.x, v.y, v.z);
  Surface result;
  Watch watch(progress);
  CGAL::alpha_wrap_3(points, surface.triangles, alpha, offset, result, CGAL::parameters::default_values(),
                     CGAL::parameters::visitor(std::ref(watch)));
  return meshFrom(result);
} catch (const Cancelled&) {
  return Error{std::string(kCancelled)};
} catch (const TooFine&) {
  return Error{fmt::format("the wrap would have more than {} vertices; choose a larger alpha or offset", kMaxVertices)};
} catch (const std::exception& e) {
  return Error{fmt::format("it could not be wrapped ({}); choose another alpha or offset", oneLine(e.what()))};
}

}  // namespace cairn::builder
