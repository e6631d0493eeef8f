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

/// A mesh, a tree of it, the proof and the fit.
struct Examination {
  builder::TriangleMesh mesh;
  SphereTree tree;
  builder::Certificate certificate;
  std::vector<std::string> failures;  ///< claims of the tree that could not be proved
  std::vector<builder::LevelFit> fits;
};

/// Reads both files, certifies the tree and measures the fit, as `sampling` selects; `seed` is for the samples. Fails
/// with the name of the file. If the tree was built from a file with other bytes, a note appears on standard error: the
/// same mesh in another format is a valid question.
Result<Examination> examine(const std::string& meshPath, const std::string& treePath, builder::Sampling sampling,
                            std::uint64_t seed);

/// Returns the keys that every examination reports.
Json examinationJson(const Examination& examination, builder::Sampling sampling, unsigned threads);

/// Prints the first failure as one sentence and returns the exit code.
int refuseUnproved(const Examination& examination, const std::string& treePath);

}  // namespace cairn::tool
