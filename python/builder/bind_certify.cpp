// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <span>

#include "builder/mesh_arrays.h"
#include "builder/types.h"
#include "builder/waiting.h"
#include "cairn/builder/certify.h"
#include "cairn/builder/certify_balls.h"
#include "common/views.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

/// Python's `TreeCertificate`.
struct TreeProof {
  builder::Certificate certificate;
  std::vector<std::string> failures;
};

py::object certifyTree(const MeshPointer& mesh, const TreePointer& tree, unsigned threads, const py::object& progress) {
  const auto work = [mesh, tree](const builder::ProgressCallback& report) -> Result<TreeProof> {
    Result<builder::Certificate> certificate = builder::certify(*tree, mesh->mesh, report);
    if (!certificate) return certificate.error();
    std::vector<std::string> failures = certificate.value().failures(*tree);
    return TreeProof{std::move(certificate).value(), std::move(failures)};
  };
  return py::cast(std::make_shared<TreeProof>(valueOfWork(work, threads, progress)));
}

py::object certifySpheres(const MeshPointer& mesh, std::vector<builder::Ball> balls, unsigned threads,
                          const py::object& progress) {
  const auto work = [mesh, balls = std::move(balls)](const builder::ProgressCallback& report) {
    return builder::certifyBalls(balls, mesh->mesh, report);
  };
  return py::cast(valueOfWork(work, threads, progress));
}

py::object certify(const MeshPointer& mesh, const py::object& spheres, std::int64_t threadCount,
                   const py::object& progress) {
  const unsigned threads = threadsOf(threadCount);
  if (py::isinstance<SphereTree>(spheres)) return certifyTree(mesh, spheres.cast<TreePointer>(), threads, progress);
  if (py::isinstance<FlatCover>(spheres))
    return certifySpheres(mesh, spheres.cast<const FlatCover&>().cover.balls, threads, progress);
  return certifySpheres(mesh, ballsOfArray(spheres), threads, progress);
}

template <auto member>
py::array nodeView(const py::object& self) {
  const std::span<const builder::NodeCertificate> nodes = self.cast<const TreeProof&>().certificate.nodes;
  return columnOf(nodes, &(nodes.front().*member), self);
}

void bindLevel(py::module_& module) {
  using builder::LevelCertificate;
  py::class_<LevelCertificate> level(module, "LevelCertificate",
                                     "The proof for all nodes of a level and all leaves above it.");
  level.attr("__module__") = "cairn";
  level.def_readonly("level", &LevelCertificate::level, "0 is the root.");
  level.def_readonly("spheres", &LevelCertificate::spheres, "How many balls the cut has.");
  level.def_readonly("coverage_proven", &LevelCertificate::coverageProven,
                     "Every point of the surface lies in a ball.");
  level.def_readonly("reachable_proven", &LevelCertificate::reachableProven,
                     "Every point also lies in all ancestors of such a ball.");
  level.def_readonly("max_error", &LevelCertificate::maxProtrusion,
                     "No point of a ball is farther from the solid, mesh unit.");
  level.def_readonly("rms_error", &LevelCertificate::rmsProtrusion,
                     "Root mean square of that bound over the balls, mesh unit.");
}

void bindTreeCertificate(py::module_& module) {
  py::class_<TreeProof, std::shared_ptr<TreeProof>> proof(
      module, "TreeCertificate", "What could be proved about a tree. Arrays are read-only views that keep it alive.");
  proof.attr("__module__") = "cairn";
  proof.def_property_readonly(
      "proven", [](const TreeProof& p) { return p.failures.empty(); }, "Whether every claim of the tree was proved.");
  proof.def_readonly("failures", &TreeProof::failures, "One sentence a failed claim; empty when all was proved.");
  proof.def_property_readonly(
      "levels", [](const TreeProof& p) { return p.certificate.levels; }, "A LevelCertificate a level, the root first.");
  proof.def_property_readonly("errors_at_most", &nodeView<&builder::NodeCertificate::protrusionUpper>,
                              "No point of a node's ball is farther from the solid. Shape (n,), float64, mesh unit.");
  proof.def_property_readonly("errors_at_least", &nodeView<&builder::NodeCertificate::protrusionLower>,
                              "A point of the ball is at least this far. Shape (n,), float64, mesh unit.");
  proof.def_property_readonly("depths", &nodeView<&builder::NodeCertificate::depth>,
                              "Of the centres below the surface, negative outside. Shape (n,), float64, mesh unit.");
}

void bindSpheresCertificate(py::module_& module) {
  using builder::BallsCertificate;
  using builder::EnclosedDistance;
  py::class_<EnclosedDistance> distance(module, "EnclosedDistance", "A largest distance, proved from both sides.");
  distance.attr("__module__") = "cairn";
  distance.def_readonly("at_most", &EnclosedDistance::upper, "No point is farther, mesh unit.");
  distance.def_readonly("at_least", &EnclosedDistance::lower, "A point is at least this far, mesh unit.");
  distance.def("__repr__", [](const EnclosedDistance& d) {
    return fmt::format("<cairn.EnclosedDistance from {:.6g} to {:.6g}>", d.lower, d.upper);
  });
  py::class_<BallsCertificate> certificate(module, "SpheresCertificate",
                                           "What was proved about a flat set of spheres.");
  certificate.attr("__module__") = "cairn";
  certificate.def_readonly("sticks_out", &BallsCertificate::sticksOut, "From the spheres to the solid.");
  certificate.def_readonly("leaves_out_surface", &BallsCertificate::leavesSurface,
                           "From the surface to the spheres; at most 0 where they cover it.");
  certificate.def_readonly("leaves_out_solid", &BallsCertificate::leavesSolid, "From the solid to the spheres.");
  certificate.def_property_readonly(
      "surface_covered", [](const BallsCertificate& c) { return c.leavesSurface.upper == 0; },
      "Whether every point of the surface lies in a sphere, by proof.");
}

}  // namespace

void bindCertify(py::module_& module) {
  bindLevel(module);
  bindTreeCertificate(module);
  bindSpheresCertificate(module);
  module.def("certify", &certify, py::arg("mesh").none(false), py::arg("spheres"), py::kw_only(),
             py::arg("threads") = 0, py::arg("progress") = py::none(),
             "Proves, from mesh and spheres alone, what spheres are worth, whoever made them. spheres: a SphereTree "
             "(returns a TreeCertificate), a Cover, or an array of shape (n, 4), float64 or float32, `x y z r` in the "
             "mesh's frame and unit (returns a SpheresCertificate). A failed proof is a result, not an exception. "
             "progress as in build. Raises cairn.Error for other input.");
}

}  // namespace cairn::python
