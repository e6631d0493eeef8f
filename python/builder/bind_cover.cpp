// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <span>

#include "builder/types.h"
#include "builder/waiting.h"
#include "cairn/core/atomic_file.h"
#include "common/views.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

CoverPointer cover(const MeshPointer& mesh, std::optional<std::int64_t> spheres, std::optional<double> maxError,
                   const std::string& objective, bool symmetric, const py::int_& seed, std::int64_t threads,
                   const py::object& progress) {
  if (spheres.has_value() == maxError.has_value()) refuse("give either spheres or max_error");
  builder::CoverOptions options;
  options.spheres.reset();
  if (spheres) options.spheres = countOf("spheres", *spheres);
  options.maxError = maxError;
  options.objective = valueOf(builder::parseObjective(objective));
  options.symmetric = symmetric;
  options.seed = seedOf(seed);
  const auto work = [mesh, options](const builder::ProgressCallback& report) {
    return builder::coverMesh(mesh->mesh, options, report);
  };
  return std::make_shared<FlatCover>(FlatCover{valueOfWork(work, threadsOf(threads), progress), options.objective});
}

template <auto member>
py::array ballView(const py::object& self) {
  const std::span<const builder::Ball> balls = self.cast<const FlatCover&>().cover.balls;
  if constexpr (std::is_same_v<decltype(member), Vec3d builder::Ball::*>)
    return pointsOf(balls, &(balls.front().*member), self);
  else
    return columnOf(balls, &(balls.front().*member), self);
}

std::span<const builder::BallProof> proofs(const py::object& self) {
  return self.cast<const FlatCover&>().cover.certificate.balls;
}

py::object mirror(const FlatCover& flat) {
  if (!flat.cover.mirror) return py::none();
  const builder::MirrorPlane& m = *flat.cover.mirror;
  return py::make_tuple(py::make_tuple(m.normal.x, m.normal.y, m.normal.z), m.offset);
}

void save(const FlatCover& flat, const std::filesystem::path& path) {
  require(writeFileAtomically(path, builder::coverText(flat.cover)));
}

}  // namespace

void bindCover(py::module_& module) {
  py::class_<FlatCover, CoverPointer> type(
      module, "Cover",
      "A flat set of spheres with its proof, in the mesh's frame and unit. Arrays are read-only views that keep the "
      "cover alive.");
  type.attr("__module__") = "cairn";
  type.def_property_readonly("centers", &ballView<&builder::Ball::center>, "Shape (n, 3), float64, mesh unit.");
  type.def_property_readonly("radii", &ballView<&builder::Ball::radius>, "Shape (n,), float64, mesh unit.");
  type.def_property_readonly(
      "errors", [](const py::object& self) { return columnOf(proofs(self), &proofs(self)[0].protrusion.upper, self); },
      "Proved: no point of a sphere is farther from the solid. Shape (n,), float64, mesh unit.");
  type.def_property_readonly(
      "inner_radii", [](const py::object& self) { return columnOf(proofs(self), &proofs(self)[0].innerRadius, self); },
      "Radii of concentric balls inside the solid, 0 without one. Shape (n,), float64, mesh unit.");
  type.def_property_readonly(
      "certificate", [](const FlatCover& c) { return c.cover.certificate; }, "The proof, a SpheresCertificate.");
  type.def_property_readonly(
      "objective", [](const FlatCover& c) { return builder::objectiveName(c.objective); }, "As it was asked for.");
  type.def_property_readonly(
      "error", [](const FlatCover& c) { return c.cover.error(c.objective); },
      "The proved error that the objective minimises, mesh unit.");
  type.def_property_readonly("mirror", &mirror, "(unit normal, offset in mesh units) of the plane kept, or None.");
  type.def("save", &save, py::arg("path"),
           "Writes a line `x y z r error inner` a sphere, as `cairn cover` does. Raises cairn.Error.");
  type.def("__len__", [](const FlatCover& c) { return c.cover.balls.size(); });
  type.def("__repr__", [](const FlatCover& c) {
    return fmt::format("<cairn.Cover of {} spheres, {}, error {:.6g}>", c.cover.balls.size(),
                       builder::objectiveName(c.objective), c.cover.error(c.objective));
  });
  module.def("cover", &cover, py::arg("mesh").none(false), py::arg("spheres") = py::none(), py::kw_only(),
             py::arg("max_error") = py::none(),
             py::arg("objective") = builder::objectiveName(builder::Objective::outer), py::arg("symmetric") = false,
             py::arg("seed") = 1, py::arg("threads") = 0, py::arg("progress") = py::none(),
             "Covers a mesh by exactly so many spheres, or by the fewest found that keep max_error (mesh unit). "
             "objective: outer, balanced, inner or volume. symmetric keeps a mirror plane. The spheres of "
             "`cairn cover`. progress as in build. Raises cairn.Error.");
}

}  // namespace cairn::python
