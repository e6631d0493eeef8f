// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "builder/types.h"
#include "builder/waiting.h"
#include "cairn/builder/build.h"
#include "cairn/builder/certify.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

using BalanceChoice = std::optional<std::variant<double, std::string>>;

std::optional<builder::Balance> balanceOf(const BalanceChoice& choice) {
  if (!choice) return std::nullopt;
  const auto* text = std::get_if<std::string>(&*choice);
  return valueOf(builder::parseBalance(text ? *text : fmt::format("{}", std::get<double>(*choice))));
}

/// Builds and proves, as the command line does: a tree without a proof is none.
Result<SphereTree> certifiedTree(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                                 const builder::ProgressCallback& progress) {
  Result<SphereTree> tree = builder::buildTree(mesh, options, progress);
  if (!tree) return tree;
  const Result<builder::Certificate> certificate = builder::certify(tree.value(), mesh, progress);
  if (!certificate) return certificate.error();
  const std::vector<std::string> failures = certificate.value().failures(tree.value());
  if (failures.empty()) return tree;
  return Error{fmt::format("{}: the tree could not be certified ({}); try other options and report this mesh",
                           mesh.name.empty() ? "mesh" : mesh.name, failures.front())};
}

TreePointer build(const MeshPointer& mesh, const std::string& method, std::int64_t branching, std::int64_t depth,
                  std::int64_t samples, const py::int_& seed, std::int64_t threads,
                  const std::optional<std::string>& optimise, const BalanceChoice& balance,
                  const py::object& progress) {
  builder::BuildOptions options;
  options.method = valueOf(builder::parseMethod(method));
  options.branching = countOf("branching", branching);
  options.depth = countOf("depth", depth);
  options.samples = countOf("samples", samples);
  options.seed = seedOf(seed);
  options.threads = threadsOf(threads);
  if (optimise) options.optimiser = valueOf(builder::parseOptimiser(*optimise));
  options.balance = balanceOf(balance);
  const auto work = [mesh, options](const builder::ProgressCallback& report) {
    return certifiedTree(mesh->mesh, options, report);
  };
  return std::make_shared<SphereTree>(valueOfWork(work, options.threads, progress));
}

}  // namespace

void bindBuild(py::module_& module) {
  const builder::BuildOptions usual;
  module.def("build", &build, py::arg("mesh").none(false), py::kw_only(),
             py::arg("method") = builder::methodName(usual.method), py::arg("branching") = usual.branching,
             py::arg("depth") = usual.depth, py::arg("samples") = usual.samples, py::arg("seed") = usual.seed,
             py::arg("threads") = 0, py::arg("optimise") = py::none(), py::arg("balance") = py::none(),
             py::arg("progress") = py::none(),
             "Builds a sphere-tree and proves it: the options and bytes of `cairn build`. threads: 0 is one per core; "
             "the result is the same for any number. progress(stage, fraction) is called now and then on the calling "
             "thread, and an exception in it cancels. Other Python threads run meanwhile. Raises cairn.Error.");
}

}  // namespace cairn::python
