// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/build.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/builder/level_meshes.h"
#include "hierarchy/build_options.h"
#include "hierarchy/grow_in_body.h"
#include "hierarchy/grow_levels.h"
#include "hierarchy/region_tree.h"
#include "hierarchy/tree_data.h"
#include "medial/hubbard_medial.h"
#include "regions/method_traits.h"
#include "surface/convexity.h"

namespace cairn::builder {

namespace {

/// A ball that fits its region within this fraction of the mesh's diagonal is not split further. The certificate cannot
/// distinguish it from a perfect one.
constexpr double kNegligibleFraction = 1e-6;

/// Concavities up to this fraction of the diagonal are not closed; the certificate has the same tolerance.
constexpr double kNegligibleConcavity = 1e-4;

/// Points of Hubbard's sampling, beside those on edges and those of repairs. In all it takes 2400 samples on a model of
/// 1500 triangles, about as many as the thesis author's own program.
constexpr std::size_t kHubbardSamples = 500;

BuildInfo infoOf(const TriangleMesh& mesh, const BuildOptions& options) {
  std::string method = methodName(options.method);
  if (options.optimiser) method += std::string("+optimise-") + optimiserName(*options.optimiser);
  if (options.balance) method += "+balance-" + balanceName(*options.balance);
  if (options.division != SurfaceDivision::standOff) method += std::string("+divide-") + divisionName(options.division);
  if (options.twoSpheres) method += "+two-spheres";
  return {mesh.name, mesh.sha256, std::move(method), options.branching, options.depth, options.samples, options.seed};
}

/// Splits take nearly all the time, and each level takes about as much per region. The later steps are the last tenth.
double fractionDone(std::uint32_t depth, std::uint32_t level, std::size_t done, std::size_t count) {
  const double within = static_cast<double>(done) / static_cast<double>(count);
  return 0.9 * (static_cast<double>(level) + within) / static_cast<double>(depth);
}

/// The fraction of the work that is done before the levels' meshes are made.
constexpr double kBeforeMeshes = 0.95;

/// Forwards progress from one thread at a time, and remembers a cancellation.
class Reporter {
 public:
  explicit Reporter(const ProgressCallback& callback) : callback_(callback) {}

  bool report(double fraction) {
    const std::lock_guard lock(mutex_);
    fraction_ = std::max(fraction_, fraction);
    if (!stopped_ && !callback_("fitting spheres", fraction_)) stopped_ = true;
    return !stopped_;
  }
  /// Asks whether to continue, without a progress report.
  bool keepGoing() { return report(0); }

 private:
  const ProgressCallback& callback_;
  std::mutex mutex_;
  double fraction_ = 0;
  bool stopped_ = false;
};

/// Returns an empty tree when cancelled.
RegionTree growRegions(const SignedDistance& solid, const BuildOptions& options, Reporter& reporter) {
  const KeepGoing keepGoing = [&] { return reporter.keepGoing(); };
  HubbardMedial medial;
  Region root = rootRegion(solid, options.samples);
  if (options.method == Method::hubbard) {
    medial = hubbardMedialOf(solid, kHubbardSamples, options.seed, keepGoing);
    for (std::uint32_t i = 0; i < medial.spheres.size(); ++i) root.medial.push_back(i);
  }
  const double diagonal = boundsOf(solid.mesh()).diagonal();
  const SplitSettings settings{options.method,  options.branching,
                               options.seed,    kNegligibleFraction * diagonal,
                               &medial,         options.optimiser.value_or(traitsOf(options.method).optimiser),
                               options.balance, options.division,
                               keepGoing,       isConvex(solid.mesh(), kNegligibleConcavity * diagonal)};
  const auto grow = options.method == Method::adaptive ? growLevels : growRegionTree;
  return grow(std::move(root), options.depth, solid, settings,
              [&](std::uint32_t level, std::size_t done, std::size_t count) {
                return reporter.report(fractionDone(options.depth, level, done, count));
              });
}

/// Returns nothing when cancelled.
std::optional<SphereTreeData> buildData(const TriangleMesh& mesh, const BuildOptions& options,
                                        const ProgressCallback& report) {
  Reporter reporter(report);
  const Grow grow = [&](const SignedDistance& solid) { return growRegions(solid, options, reporter); };
  const bool inBody = traitsOf(options.method).frame == GrownIn::body;
  RegionTree regions = inBody ? growInBody(mesh, grow) : RegionTree();
  const SignedDistance solid(mesh);
  if (!inBody) regions = grow(solid);
  if (regions.empty() || !reporter.keepGoing() || !report("certifying errors", 0.9)) return std::nullopt;
  SphereTreeData data = makeTreeData(regions, solid, options.twoSpheres);
  data.info = infoOf(mesh, options);
  return data;
}

/// How many spheres each level below the root has.
std::vector<std::uint32_t> spheresOfLevels(const std::vector<NodeData>& nodes) {
  std::vector<std::uint32_t> level(nodes.size(), 0), count;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    level[i] = level[nodes[i].parent] + 1;
    count.resize(std::max<std::size_t>(count.size(), level[i]));
    ++count[level[i] - 1];
  }
  return count;
}

Status addLevelMeshes(const TriangleMesh& mesh, SphereTreeData& data, const ProgressCallback& report) {
  const auto progress = [&](std::string_view stage, double done) {
    return report(stage, kBeforeMeshes + (1 - kBeforeMeshes) * done);
  };
  auto meshes = makeLevelMeshes(mesh, data.origin, spheresOfLevels(data.nodes), progress);
  if (!meshes) return meshes.error();
  data.levelMeshes = std::move(meshes).value();
  return {};
}

}  // namespace

Result<SphereTree> buildTree(const TriangleMesh& mesh, const BuildOptions& options, const ProgressCallback& progress) {
  if (Status s = checkOptions(options); !s) return s.error();
  if (Status s = checkMesh(mesh); !s) return s.error();
  const ProgressCallback report = progress ? progress : [](std::string_view, double) { return true; };
  if (!report("fitting spheres", 0)) return Error{std::string(kCancelled)};
  tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(options.threads));
  std::optional<SphereTreeData> data = arena.execute([&] { return buildData(mesh, options, report); });
  if (!data) return Error{std::string(kCancelled)};
  if (options.levelMeshes)
    if (Status s = addLevelMeshes(mesh, *data, report); !s) return s.error();
  Result<SphereTree> tree = SphereTree::create(*std::move(data));
  if (tree && !report("done", 1)) return Error{std::string(kCancelled)};
  return tree;
}

}  // namespace cairn::builder
