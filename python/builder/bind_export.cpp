// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "builder/mesh_arrays.h"
#include "builder/types.h"
#include "builder/waiting.h"
#include "cairn/builder/export.h"
#include "cairn/builder/grain.h"
#include "tool/export_formats.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

using tool::ExportFormat;
using tool::ExportPart;
using tool::ExportSource;

const ExportFormat& formatOf(const std::string& name) {
  const std::vector<std::string> names = tool::exportFormatNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
    refuse(fmt::format("there is no form '{}'; choose one of {}", name, fmt::join(names, ", ")));
  return tool::exportFormat(name);
}

ExportSource treeSource(const SphereTree& tree, const ExportFormat& format, std::optional<std::int64_t> level) {
  if (level && format.part == ExportPart::tree)
    refuse(fmt::format("level is for single levels; {} always holds the whole tree", format.name));
  ExportSource source;
  source.tree = tree;
  source.balls = valueOf(builder::ballsOfLevel(tree, level ? countOf("level", *level) : tree.depth()));
  source.mass = tree.mass();
  source.massOfMesh = true;
  return source;
}

ExportSource flatSource(std::vector<builder::Ball> balls, const ExportFormat& format,
                        std::optional<std::int64_t> level) {
  if (level || format.part == ExportPart::tree)
    refuse(fmt::format("a flat set of spheres has no levels, which {} needs; give a tree",
                       level ? std::string("level") : std::string(format.name)));
  ExportSource source;
  source.balls = std::move(balls);
  source.mass = builder::massOf(source.balls);
  return source;
}

ExportSource sourceOf(const py::object& spheres, const ExportFormat& format, std::optional<std::int64_t> level) {
  if (py::isinstance<SphereTree>(spheres)) return treeSource(spheres.cast<const SphereTree&>(), format, level);
  if (py::isinstance<FlatCover>(spheres))
    return flatSource(spheres.cast<const FlatCover&>().cover.balls, format, level);
  return flatSource(ballsOfArray(spheres), format, level);
}

void exportTo(const py::object& spheres, const std::filesystem::path& path, const std::string& to,
              std::optional<std::int64_t> level, const MeshPointer& mesh) {
  const ExportFormat& format = formatOf(to);
  ExportSource source = sourceOf(spheres, format, level);
  if (mesh) {
    if (format.part != ExportPart::grain) refuse("mesh is for grains: liggghts, yade, chrono, clump");
    source.mass = builder::massOf(mesh->mesh);
    source.massOfMesh = true;
  }
  const auto work = [source = std::move(source), &format, path](const builder::ProgressCallback&) -> Result<bool> {
    if (Status s = format.write(source, path); !s) return s.error();
    return true;
  };
  valueOfWork(work, 0, py::none());
}

}  // namespace

void bindExport(py::module_& module) {
  module.def("export", &exportTo, py::arg("spheres"), py::arg("path"), py::kw_only(), py::arg("to"),
             py::arg("level") = py::none(), py::arg("mesh") = py::none(),
             "Writes a SphereTree, a Cover or an array as in certify in another form, whole or not at all: the forms "
             "and frames of `cairn export --to`. level: of a tree, the deepest unless given. mesh: what a grain stands "
             "for. Raises cairn.Error.");
}

}  // namespace cairn::python
