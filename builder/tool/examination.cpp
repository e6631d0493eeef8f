// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/examination.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/progress_bar.h"
#include "tool/stopwatch.h"

namespace cairn::tool {

Result<Examination> examine(const std::string& meshPath, const std::string& treePath, builder::Sampling sampling,
                            std::uint64_t seed) {
  Result<builder::TriangleMesh> mesh = builder::importMesh(meshPath);
  if (!mesh) return mesh.error();
  Result<SphereTree> tree = loadTree(treePath);
  if (!tree) return tree.error();
  const std::string& builtFrom = tree.value().info().meshSha256;
  if (!builtFrom.empty() && builtFrom != mesh.value().sha256)
    fmt::print(stderr, "cairn: note: {} was built from a file of other content ({})\n", treePath,
               tree.value().info().meshName);
  ProgressBar bar;
  auto certificate = builder::certify(tree.value(), mesh.value(), bar.callback());
  if (!certificate) return certificate.error();
  auto fits = builder::evaluate(tree.value(), mesh.value(), certificate.value(), sampling, seed, bar.callback());
  if (!fits) return fits.error();
  std::vector<std::string> failures = certificate.value().failures(tree.value());
  return Examination{std::move(mesh).value(), std::move(tree).value(), std::move(certificate).value(),
                     std::move(failures), std::move(fits).value()};
}

Json examinationJson(const Examination& examination, builder::Sampling sampling, unsigned threads) {
  Json json = buildInfoJson(examination.tree);
  json["mesh"] = examination.mesh.name;
  json["threads"] = threadsUsed(threads);
  json["build_cpu_s"] = nullptr;  // a tree file does not tell
  json["build_wall_s"] = nullptr;
  json["peak_rss_mb"] = peakMemoryMb();
  json["tree_sha256"] = treeSha256(examination.tree);
  json["proven"] = examination.failures.empty();
  json["levels"] = levelsJson(examination.fits, sampling);
  return json;
}

int refuseUnproved(const Examination& examination, const std::string& treePath) {
  const std::vector<std::string>& failures = examination.failures;
  if (failures.empty()) return kDone;
  return refuse({fmt::format("{}: {} of its claims about {} failed, the first: {}", treePath, failures.size(),
                             examination.mesh.name, failures.front())});
}

}  // namespace cairn::tool
