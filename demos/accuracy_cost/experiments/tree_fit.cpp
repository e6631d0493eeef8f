// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/tree_fit.h"

#include <utility>

#include "cairn/builder/certify.h"

namespace cairn::accuracy_cost {

namespace {

/// Finished shares of the work after the tree is built, and after it is proved.
constexpr double kBuilt = 0.8, kProven = 0.9;

/// The progress of work within other work.
builder::ProgressCallback partOf(const builder::ProgressCallback& progress, double from, double to) {
  if (!progress) return {};
  return [&progress, from, to](std::string_view stage, double fraction) {
    return progress(stage, from + fraction * (to - from));
  };
}

/// A tree and its proof.
struct Proven {
  SphereTree tree;
  builder::Certificate certificate;
};

Result<Proven> proven(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                      const builder::ProgressCallback& progress) {
  auto tree = builder::buildTree(mesh, options, partOf(progress, 0, kBuilt));
  if (!tree) return tree.error();
  auto certificate = builder::certify(tree.value(), mesh, partOf(progress, kBuilt, kProven));
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
  return builder::evaluate(tree, mesh, certificate, builder::Sampling::full, options.seed,
                           partOf(progress, kProven, 1));
}

}  // namespace cairn::accuracy_cost
