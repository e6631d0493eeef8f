// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <span>

#include "builder/mesh_arrays.h"
#include "builder/types.h"
#include "builder/waiting.h"
#include "cairn/builder/grain.h"
#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "cairn/builder/wrap.h"
#include "common/views.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

MeshPointer make(const py::object& vertices, const py::object& triangles, const std::string& name) {
  auto solid = std::make_shared<SolidMesh>(SolidMesh{meshOfArrays(vertices, triangles, name), {}});
  const auto check = [solid](const builder::ProgressCallback&) -> Result<MeshPointer> {
    if (Status s = builder::checkMesh(solid->mesh); !s) return s.error();
    return solid;
  };
  return valueOfWork(check, 0, py::none());
}

Result<SolidMesh> asItIs(builder::TriangleMesh surface, std::size_t leftOut) {
  if (Status s = builder::checkMesh(surface, leftOut); !s)
    return Error{s.error().message + ", or try repair=True or wrap=True"};
  return SolidMesh{std::move(surface), {}};
}

Result<SolidMesh> repaired(const builder::TriangleMesh& surface, double weld) {
  builder::RepairCounts counts;
  Result<builder::TriangleMesh> mesh = builder::repair(surface, &counts, {.weld = weld});
  if (!mesh) return Error{mesh.error().message + "; try wrap=True"};
  return SolidMesh{std::move(mesh).value(), "repaired: " + counts.text()};
}

Result<SolidMesh> wrapped(const builder::TriangleMesh& surface, const builder::WrapOptions& options,
                          const builder::ProgressCallback& progress) {
  Result<builder::Wrap> wrap = builder::wrap(surface, options, progress);
  if (!wrap) return wrap.error();
  std::string changes = fmt::format("wrapped in {} triangles, nowhere farther than {:.6g} from the original surface",
                                    wrap.value().mesh.triangles.size(), wrap.value().farthestUpper);
  return SolidMesh{std::move(wrap.value().mesh), std::move(changes)};
}

MeshPointer loadMesh(const std::filesystem::path& path, bool repair, double weld, bool wrap, double alpha,
                     double offset, std::optional<double> wrapError, const py::object& progress) {
  if (repair && wrap) refuse("repair and wrap exclude each other; choose one");
  if (!(weld >= 0 && weld <= builder::kMaxWeld))
    refuse(fmt::format("weld is {}; give a fraction of the diagonal from 0 to {}", weld, builder::kMaxWeld));
  const builder::WrapOptions options{alpha, offset, wrapError};
  const auto work = [=](const builder::ProgressCallback& report) -> Result<SolidMesh> {
    builder::ImportCounts counts;
    Result<builder::TriangleMesh> surface = builder::importSurface(path, &counts);
    if (!surface) return surface.error();
    if (repair) return repaired(surface.value(), weld);
    if (wrap) return wrapped(surface.value(), options, report);
    return asItIs(std::move(surface).value(), counts.degenerateTriangles);
  };
  return std::make_shared<SolidMesh>(valueOfWork(work, 0, progress));
}

py::array vertices(const py::object& self) {
  const std::span<const Vec3d> points = self.cast<const SolidMesh&>().mesh.vertices;
  return pointsOf(points, points.data(), self);
}

py::array triangles(const py::object& self) {
  return triplesOf(std::span<const builder::Triangle>(self.cast<const SolidMesh&>().mesh.triangles), self);
}

py::tuple bounds(const SolidMesh& solid) {
  const builder::Bounds box = builder::boundsOf(solid.mesh);
  return py::make_tuple(py::make_tuple(box.lower.x, box.lower.y, box.lower.z),
                        py::make_tuple(box.upper.x, box.upper.y, box.upper.z));
}

std::string represent(const SolidMesh& solid) {
  return fmt::format("<cairn.TriangleMesh {}of {} vertices and {} triangles>",
                     solid.mesh.name.empty() ? "" : fmt::format("'{}' ", solid.mesh.name), solid.mesh.vertices.size(),
                     solid.mesh.triangles.size());
}

}  // namespace

void bindMesh(py::module_& module) {
  py::class_<SolidMesh, MeshPointer> mesh(
      module, "TriangleMesh",
      "A closed triangle mesh that bounds a solid; it never changes. vertices: shape (n, 3), float64 or float32, any "
      "unit. triangles: shape (m, 3), whole numbers of 32 or 64 bits, rows of vertices, counter-clockwise seen from "
      "outside. The numbers are copied once, 24 bytes a vertex and 12 bytes a triangle. name: for messages and files. "
      "Raises cairn.Error for other arrays, and for a mesh that is open, crosses itself or faces inward.");
  mesh.attr("__module__") = "cairn";
  mesh.def(py::init(&make), py::arg("vertices"), py::arg("triangles"), py::kw_only(), py::arg("name") = "");
  mesh.def_property_readonly("vertices", &vertices, "Shape (n, 3), float64, mesh unit. A read-only view.");
  mesh.def_property_readonly("triangles", &triangles, "Shape (m, 3), uint32, rows of vertices. A read-only view.");
  mesh.def_property_readonly(
      "name", [](const SolidMesh& m) { return m.mesh.name; }, "For messages and files.");
  mesh.def_property_readonly(
      "sha256", [](const SolidMesh& m) { return m.mesh.sha256; }, "Of the file's bytes; empty without a file.");
  mesh.def_property_readonly(
      "changes", [](const SolidMesh& m) { return m.changes; }, "What repair or wrap did; empty without.");
  mesh.def_property_readonly("bounds", &bounds, "Least and greatest coordinates, two tuples of three floats.");
  mesh.def_property_readonly(
      "diagonal", [](const SolidMesh& m) { return builder::boundsOf(m.mesh).diagonal(); },
      "Length of the bounding box's diagonal, to which fractions refer; mesh unit.");
  mesh.def_property_readonly(
      "volume", [](const SolidMesh& m) { return builder::massOf(m.mesh).volume; }, "Of the solid, mesh unit cubed.");
  mesh.def("__repr__", &represent);
  mesh.def("__copy__", [](const py::object& self) { return self; });
  mesh.def(
      "__deepcopy__", [](const py::object& self, const py::dict&) { return self; }, py::arg("memo"));
  module.def("load_mesh", &loadMesh, py::arg("path"), py::kw_only(), py::arg("repair") = false,
             py::arg("weld") = builder::RepairOptions{}.weld, py::arg("wrap") = false,
             py::arg("wrap_alpha") = builder::WrapOptions{}.alpha,
             py::arg("wrap_offset") = builder::WrapOptions{}.offset, py::arg("wrap_error") = py::none(),
             py::arg("progress") = py::none(),
             "Reads a mesh file: OBJ, OFF, PLY, STL, glTF and what else assimp knows. repair closes holes, turns "
             "triangles and unites bodies, over gaps of at most weld, a fraction of the diagonal; wrap builds a closed "
             "skin around any surface, with wrap_alpha and wrap_offset as fractions of "
             "the diagonal, made finer until it is at most wrap_error away. Raises cairn.Error with the file's name.");
}

}  // namespace cairn::python
