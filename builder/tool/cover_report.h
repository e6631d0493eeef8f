// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "cairn/builder/cover.h"
#include "cairn/builder/evaluate.h"
#include "cairn/builder/triangle_mesh.h"
#include "tool/report.h"

namespace cairn::tool {

/// A cover and what is known of it.
struct CoverReport {
  const builder::TriangleMesh& mesh;
  const builder::Cover& cover;
  const builder::CoverOptions& options;
  std::optional<builder::LevelFit> sampled;
};

/// The keys of `cairn cover --json`: proved distances, sampled ones beside them, volumes and mass.
Json coverJson(const CoverReport& report);

/// The same as sentences and a small table on standard output.
void printCover(const CoverReport& report);

/// The key `certified` of a set of spheres, and its part of what is printed. `diagonal`: of the mesh's bounding box.
Json certifiedJson(const builder::BallsCertificate& certificate, double diagonal);
void printCertified(const builder::BallsCertificate& certificate, double diagonal);

}  // namespace cairn::tool
