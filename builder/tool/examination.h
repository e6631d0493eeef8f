// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/builder/certify.h"
#include "cairn/builder/evaluate.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"
#include "tool/report.h"

namespace cairn::tool {

/// A mesh, a tree that is said to bound it, and how well it does.
struct Examination {
  builder::TriangleMesh mesh;
  SphereTree tree;
  builder::Certificate certificate;
  std::vector<std::string> failures;  ///< claims of the tree that could not be proved
  std::vector<builder::LevelFit> fits;
};

/// Reads both files, proves what can be proved and measures the fit, `sampling` deciding how; `seed` is the samples'.
/// An error names the file. A tree built from a file of other bytes is accepted with a note on standard error: the same
/// mesh in another format is a fair question.
Result<Examination> examine(const std::string& meshPath, const std::string& treePath, builder::Sampling sampling,
                            std::uint64_t seed);

/// The report's keys every examination has.
Json examinationJson(const Examination& examination, builder::Sampling sampling, unsigned threads);

/// Ends a command: the exit code, and the first failure as one sentence.
int refuseUnproved(const Examination& examination, const std::string& treePath);

}  // namespace cairn::tool
