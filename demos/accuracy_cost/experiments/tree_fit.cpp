// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/tree_fit.h"

#include "cairn/builder/certify.h"

namespace cairn::accuracy_cost {

Result<std::vector<builder::LevelFit>> treeFit(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                                               const builder::ProgressCallback& progress) {
  const auto tree = builder::buildTree(mesh, options, progress);
  if (!tree) return tree.error();
  const auto certificate = builder::certify(tree.value(), mesh, progress);
  if (!certificate) return certificate.error();
  if (const auto failures = certificate.value().failures(tree.value()); !failures.empty())
    return Error{failures.front()};
  return builder::evaluate(tree.value(), mesh, certificate.value(), builder::Sampling::full, options.seed, progress);
}

}  // namespace cairn::accuracy_cost
