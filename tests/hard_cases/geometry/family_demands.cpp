// SPDX-License-Identifier: GPL-3.0-or-later
#include "family_demands.h"

#include <algorithm>
#include <cmath>

#include "builder_meshes.h"
#include "cairn/builder/certify.h"
#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"
#include "oracle/chain_of_balls.h"
#include "run_program.h"

namespace cairn::hard {
namespace {

std::uint64_t notFiniteOf(const SphereTree& tree) {
  const SphereTreeData& data = tree.data();
  std::uint64_t count = 0;
  const auto look = [&](const auto& v) { count += isFinite(v) ? 0 : 1; };
  for (const NodeData& node : data.nodes) {
    look(node.center);
    look(node.normalCone.axis);
    look(Vec3(node.radius, node.error, node.innerRadius));
  }
  for (const auto* list : {&data.supportPoints, &data.faceNormals, &data.vertices}) std::ranges::for_each(*list, look);
  for (const Vec3d& row : data.mass.inertia.rows) look(row);
  for (const Vec3d& row : data.mass.principalAxes.rows) look(row);
  look(data.origin);
  look(data.mass.centerOfMass);
  look(data.mass.principalMoments);
  return count;
}

std::string ofMany(std::uint64_t count) {
  return "of " + std::to_string(count);
}

}  // namespace

builder::BuildOptions FamilyDemands::options() const {
  builder::BuildOptions options;
  options.depth = effort_ == Effort::quick ? 2 : 3;
  options.samples = effort_ == Effort::quick ? 1000 : 5000;
  return options;
}

std::optional<SphereTree> FamilyDemands::build(const builder::TriangleMesh& mesh,
                                               const builder::BuildOptions& options) {
  const Clock::time_point start = Clock::now();
  auto tree = accepted(builder::buildTree(mesh, options));
  noteTime(start);
  if (!tree) return {};
  builder::BuildOptions alone = options;
  alone.threads = 1;
  const auto again = builder::buildTree(mesh, alone);
  if (!again || encodeTree(again.value()) != encodeTree(*tree)) ++otherBytes_;
  examine(*tree, mesh);
  return tree;
}

void FamilyDemands::examine(const SphereTree& tree, const builder::TriangleMesh& mesh) {
  ++trees_;
  notFinite_ += notFiniteOf(tree);
  if (const auto certificate = accepted(builder::certify(tree, mesh)))
    for (const std::string& failure : certificate->failures(tree)) {
      ++unproved_;
      if (firstWrong_.empty()) firstWrong_ = failure;
    }
  std::mt19937_64 engine(trees_);
  const std::uint64_t points = effort_ == Effort::quick ? 2000 : 100000;
  for (std::uint64_t i = 0; i < points; ++i)
    if (!liesInAChain(tree, randomSurfacePoint(mesh, engine))) ++outside_;
  points_ += points;
}

Result<builder::TriangleMesh> FamilyDemands::import(const std::string& name, const std::string& bytes) {
  const test::TemporaryFolder folder;
  const auto path = test::writeText(folder.path() / name, bytes);
  const Clock::time_point start = Clock::now();
  Result<builder::TriangleMesh> mesh = builder::importMesh(path);
  noteTime(start);
  return mesh;
}

Result<builder::TriangleMesh> FamilyDemands::importSurface(const std::string& name, const std::string& bytes) {
  const test::TemporaryFolder folder;
  const auto path = test::writeText(folder.path() / name, bytes);
  const Clock::time_point start = Clock::now();
  Result<builder::TriangleMesh> mesh = builder::importSurface(path);
  noteTime(start);
  return mesh;
}

void FamilyDemands::noteTime(Clock::time_point start) {
  slowest_ = std::max(slowest_, std::chrono::duration<double>(Clock::now() - start).count());
}

void FamilyDemands::tell(const std::string& wrong) {
  ++wrongAnswers_;
  if (firstWrong_.empty()) firstWrong_ = wrong;
}

bool FamilyDemands::refused(const Error* error, std::string_view named) {
  ++refusals_;
  if (error == nullptr) {
    tell("accepted where '" + std::string(named) + "' was to be said");
    return false;
  }
  const std::string& message = error->message;
  const bool isNamed =
      !message.empty() && message.find('\n') == std::string::npos && message.find(named) != std::string::npos;
  if (!isNamed) tell("'" + message + "' instead of '" + std::string(named) + "'");
  return isNamed;
}

void FamilyDemands::addTo(Outcome& outcome) const {
  const auto none = [&](const char* name, std::uint64_t count, const std::string& unit) {
    outcome.measures.push_back({name, double(count), 0, Bound::atMost, unit, "", 0});
  };
  none("wrong answers: refused, or by another name", wrongAnswers_, ofMany(trees_ + refusals_));
  if (trees_ > 0) {
    none("numbers that are not finite", notFinite_, "");
    none("trees with other bytes the second time", otherBytes_, ofMany(trees_));
    none("failures of certificates", unproved_, "");
    none("surface points outside every chain of balls", outside_, ofMany(points_));
  }
  outcome.measures.push_back({"slowest answer", slowest_, seconds_, Bound::atMost, "s", "", 0});
  if (outcome.why.empty()) outcome.why = firstWrong_;
}

}  // namespace cairn::hard
