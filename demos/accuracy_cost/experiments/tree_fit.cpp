// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/tree_fit.h"

#include <utility>

#include "cairn/builder/certify.h"

namespace cairn::accuracy_cost {

namespace {

/// A tree and the proof of it.
struct Proven {
  SphereTree tree;
  builder::Certificate certificate;
};

Result<Proven> proven(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                      const builder::ProgressCallback& progress) {
  auto tree = builder::buildTree(mesh, options, progress);
  if (!tree) return tree.error();
  auto certificate = builder::certify(tree.value(), mesh, progress);
  if (!certificate) return certificate.error();
  if (const auto failures = certificate.value().failures(tree.value()); !failures.empty())
    return Error{failures.front()};
  return Proven{std::move(tree).value(), std::move(certificate).value()};
}

}  // namespace

Result<SphereTree> provenTree(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                              const builder::ProgressCallback& progress) {
  auto made = proven(mesh, options, progress);
  if (!made) return made.error();
  return std::move(made.value().tree);
}

Result<std::vector<builder::LevelFit>> treeFit(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                                               const builder::ProgressCallback& progress) {
  const auto made = proven(mesh, options, progress);
  if (!made) return made.error();
  const auto& [tree, certificate] = made.value();
  return builder::evaluate(tree, mesh, certificate, builder::Sampling::full, options.seed, progress);
}

}  // namespace cairn::accuracy_cost
