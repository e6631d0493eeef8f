// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "builder/mesh_arrays.h"
#include "builder/types.h"
#include "builder/waiting.h"
#include "cairn/builder/evaluate.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

using builder::LevelFit;

std::vector<LevelFit> evaluateTree(const MeshPointer& mesh, const TreePointer& tree, builder::Sampling sampling,
                                   std::uint64_t seed, unsigned threads, const py::object& progress) {
  const auto work = [=](const builder::ProgressCallback& report) -> Result<std::vector<LevelFit>> {
    const Result<builder::Certificate> certificate = builder::certify(*tree, mesh->mesh, report);
    if (!certificate) return certificate.error();
    return builder::evaluate(*tree, mesh->mesh, certificate.value(), sampling, seed, report);
  };
  return valueOfWork(work, threads, progress);
}

std::vector<LevelFit> evaluateSpheres(const MeshPointer& mesh, std::vector<builder::Ball> balls, std::uint64_t seed,
                                      unsigned threads, const py::object& progress) {
  const auto work = [mesh, balls = std::move(balls), seed](const builder::ProgressCallback& report) {
    return builder::evaluateBalls(balls, mesh->mesh, seed, report);
  };
  return {valueOfWork(work, threads, progress)};
}

std::vector<LevelFit> evaluate(const MeshPointer& mesh, const py::object& spheres, bool sampled, const py::int_& seed,
                               std::int64_t threadCount, const py::object& progress) {
  const unsigned threads = threadsOf(threadCount);
  if (py::isinstance<SphereTree>(spheres)) {
    const auto sampling = sampled ? builder::Sampling::full : builder::Sampling::none;
    return evaluateTree(mesh, spheres.cast<TreePointer>(), sampling, seedOf(seed), threads, progress);
  }
  if (!sampled) refuse("sampled=False is for trees; certify gives what is proved about other spheres");
  if (py::isinstance<FlatCover>(spheres))
    return evaluateSpheres(mesh, spheres.cast<const FlatCover&>().cover.balls, seedOf(seed), threads, progress);
  return evaluateSpheres(mesh, ballsOfArray(spheres), seedOf(seed), threads, progress);
}

std::string represent(const LevelFit& fit) {
  return fmt::format("<cairn.LevelFit level {}, {} spheres, certified_max_fraction {:.6g}>", fit.level, fit.spheres,
                     fit.certifiedMaxFraction);
}

void bindFit(py::module_& module) {
  py::class_<LevelFit> fit(module, "LevelFit",
                           "How a level fits its mesh. Lengths are fractions of the mesh's bounding-box diagonal, "
                           "volumes of the solid's volume. certified_ is proved, the rest is sampled.");
  fit.attr("__module__") = "cairn";
  fit.def_readonly("level", &LevelFit::level, "0 is the root, or a flat set.");
  fit.def_readonly("spheres", &LevelFit::spheres, "How many spheres the cut has.");
  fit.def_readonly("certified_max_fraction", &LevelFit::certifiedMaxFraction, "Upper bound of the worst error.");
  fit.def_readonly("certified_rms_fraction", &LevelFit::certifiedRmsFraction, "Root mean square of the bounds.");
  fit.def_readonly("sampled_max_fraction", &LevelFit::sampledMaxFraction, "The largest error at sample points.");
  fit.def_readonly("sampled_rms_fraction", &LevelFit::sampledRmsFraction, "Root mean square of these errors.");
  fit.def_readonly("uncovered_area_fraction", &LevelFit::uncoveredAreaFraction, "Share of the area outside.");
  fit.def_readonly("uncovered_volume_fraction", &LevelFit::uncoveredVolumeFraction, "Volume of the solid outside.");
  fit.def_readonly("wasted_volume_fraction", &LevelFit::wastedVolumeFraction,
                   "Volume of the spheres out of the solid.");
  fit.def_readonly("coverage_proven", &LevelFit::coverageProven, "See LevelCertificate.");
  fit.def_readonly("reachable_proven", &LevelFit::reachableProven, "See LevelCertificate.");
  fit.def("__repr__", &represent);
}

}  // namespace

void bindEvaluate(py::module_& module) {
  bindFit(module);
  module.def(
      "evaluate", &evaluate, py::arg("mesh").none(false), py::arg("spheres"), py::kw_only(), py::arg("sampled") = true,
      py::arg("seed") = 1, py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Measures how well spheres fit a mesh: a list with a LevelFit for levels 1 to the deepest of a SphereTree, "
      "or one for a Cover or an array as in certify. sampled=False leaves out the slow measures of a tree. "
      "progress as in build. Raises cairn.Error.");
}

}  // namespace cairn::python
