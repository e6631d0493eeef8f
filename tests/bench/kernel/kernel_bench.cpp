// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of the contact kernel, stage by stage: two bodies of a tree at random poses in which they just touch. Beside
// it the traversal of their spheres, and the gaps along the lines of their leaves' centres, which know no contact. One
// thread, CPU time, medians of runs.
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "cairn/core/atomic_file.h"
#include "cairn/core/region_separation.h"
#include "cairn/core/state_hash.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/tree_pair_traversal.h"
#include "cpu_seconds.h"
#include "kernel/contact_kernel.h"
#include "kernel/contact_tuning.h"

namespace cairn::bench {
namespace {

using namespace bullet;

struct Options {
  std::vector<std::string> trees;
  std::string json;
  std::size_t poses = 300, runs = 7;
  std::uint64_t seed = 1;
};

struct Meeting {
  PlacedTree a, b;
  std::vector<NodePair> leafPairs;
};

// The time of a run over all poses, in microseconds a pair of bodies, and its contacts.
struct Figures {
  double traversal = 0, separations = 0;
  double patches = 0, features = 0, decisions = 0, crossings = 0, regions = 0, whole = 0, carriedLists = 0;
  double leafPairs = 0, nearPatches = 0, listed = 0, contacts = 0;
  std::string hash;
};

double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * std::generate_canonical<double, 53>(engine);
}

Vec3d randomDirection(std::mt19937_64& engine) {
  const double z = uniform(engine, -1, 1), turn = uniform(engine, 0, 6.283185307179586), r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

Mat3d randomRotation(std::mt19937_64& engine) {
  const Vec3d x = randomDirection(engine), z = normalized(cross(x, randomDirection(engine)));
  return transpose(Mat3d{{x, cross(z, x), z}});
}

float sizeOf(const SphereTree& tree) {
  const Box& box = tree.surface().patches.box();
  return length(box.upper - box.lower);
}

ContactLimits limitsOf(const SphereTree& tree) {
  ContactLimits limits;
  limits.size = sizeOf(tree);
  limits.contactDistance = limits.maxSeparation = tuning::kContactDistance * limits.size;
  limits.thickness = tree.surface().thickness;
  limits.trustedDepth = std::min(tuning::kTrustedDepth * limits.size, tuning::kTrustedThickness * limits.thickness);
  return limits;
}

std::vector<NodePair> leafPairsOf(const PlacedTree& a, const PlacedTree& b, float reach) {
  TreePairTraversal traversal;
  Budget budget = Budget::unlimited();
  traversal.start(a.tree(), b.tree(), a.pose(), b.pose(), reach);
  traversal.refine(budget);
  return {traversal.leafPairs().begin(), traversal.leafPairs().end()};
}

// Where the bodies have come in until they first touch.
Meeting meet(const SphereTree& tree, std::mt19937_64& engine, ContactKernel& kernel) {
  const Pose b{randomRotation(engine), {}, 1};
  const Mat3d rotation = randomRotation(engine);
  const Vec3d way = randomDirection(engine);
  const auto at = [&](double apart) { return PlacedTree(tree, Pose{rotation, way * apart, 1}); };
  const PlacedTree placedB(tree, b);
  const ContactLimits limits = limitsOf(tree);
  double near = 0, far = 2 * double(sizeOf(tree));
  for (int halving = 0; halving < 24; ++halving) {
    const double middle = (near + far) / 2;
    KernelMemory memory;
    Budget budget = Budget::unlimited();
    const auto answer = kernel.run(SurfacePair::of(at(middle), placedB), limits, memory, {}, budget);
    (answer && !answer->contacts.empty() ? near : far) = middle;
  }
  return {at(near), placedB, leafPairsOf(at(near), placedB, limits.maxSeparation)};
}

// Microseconds a meeting, median of the runs.
template <class Work>
double timed(const Options& options, std::size_t meetings, const Work& work) {
  std::vector<double> seconds;
  for (std::size_t run = 0; run < options.runs; ++run) {
    const double began = cpuSeconds();
    work();
    seconds.push_back(cpuSeconds() - began);
  }
  std::ranges::nth_element(seconds, seconds.begin() + std::ptrdiff_t(seconds.size() / 2));
  return 1e6 * seconds[seconds.size() / 2] / double(meetings);
}

// The stages, each with what the one before found.
class Stages {
 public:
  Stages(const SphereTree& tree, const std::vector<Meeting>& meetings) : tree_(tree), meetings_(meetings) {
    limits_ = limitsOf(tree);
    limits_.trustedDepth = std::min(limits_.trustedDepth, limits_.contactDistance);
    for (const Meeting& m : meetings) surfaces_.push_back(SurfacePair::of(m.a, m.b));
    near_.resize(meetings.size());
    lists_.resize(meetings.size());
    contacts_.resize(meetings.size());
    crossings_.resize(meetings.size());
  }

  void findPatches() {
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      lister_.begin(surfaces_[i], limits_);
      lister_.findNear(near_[i], unlimited_);
    }
  }
  void listFeatures() {
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      lister_.begin(surfaces_[i], limits_);
      lister_.list(near_[i], 0, Asked::all, lists_[i], unlimited_);
    }
  }
  void decide() {
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      contacts_[i].clear();
      placed_.begin(surfaces_[i]);
      FeatureContacts(surfaces_[i], placed_, limits_).append(lists_[i], 0, contacts_[i]);
    }
  }
  void cross() {
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      crossings_[i].clear();
      placed_.begin(surfaces_[i]);
      appendCrossings(surfaces_[i], placed_, lists_[i], 0, crossings_[i]);
    }
  }
  void findRegions() {
    for (std::size_t i = 0; i < meetings_.size(); ++i)
      regions_.find(surfaces_[i], limits_, contacts_[i], crossings_[i], unlimited_);
  }
  // With what was listed a step ago, if there is.
  void run(std::vector<KernelMemory>& memories) {
    found_ = 0;
    hash_ = {};
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      const auto answer =
          kernel_.run(SurfacePair::of(meetings_[i].a, meetings_[i].b), limits_, memories[i], {}, unlimited_);
      found_ += answer->contacts.size();
      for (const FeatureContact& c : answer->contacts)
        for (const float v :
             {c.position.x, c.position.y, c.position.z, c.normal.x, c.normal.y, c.normal.z, c.separation})
          hash_.add(v);
    }
  }
  void count(Figures& figures) const {
    const auto mean = [&](const auto& lists) {
      double sum = 0;
      for (const auto& list : lists) sum += double(list.size());
      return sum / double(lists.size());
    };
    figures.nearPatches = mean(near_);
    figures.listed = mean(lists_);
    figures.contacts = double(found_) / double(meetings_.size());
    figures.hash = hash_.hex();
  }

 private:
  const SphereTree& tree_;
  const std::vector<Meeting>& meetings_;
  ContactLimits limits_;
  Budget unlimited_ = Budget::unlimited();
  std::vector<SurfacePair> surfaces_;
  std::vector<std::vector<PatchPair>> near_;
  std::vector<FeatureLists> lists_;
  std::vector<std::vector<FeatureContact>> contacts_;
  std::vector<std::vector<Crossing>> crossings_;
  FeatureLister lister_;
  PlacedPair placed_;
  OverlapRegions regions_;
  ContactKernel kernel_;
  std::size_t found_ = 0;
  StateHash hash_;
};

void timeSpheres(const Options& options, const std::vector<Meeting>& meetings, const ContactLimits& limits,
                 Figures& figures) {
  TreePairTraversal traversal;
  figures.traversal = timed(options, meetings.size(), [&] {
    for (const Meeting& m : meetings) {
      Budget budget = Budget::unlimited();
      traversal.start(m.a.tree(), m.b.tree(), m.a.pose(), m.b.pose(), limits.maxSeparation);
      traversal.refine(budget);
    }
  });
  for (const Meeting& m : meetings) figures.leafPairs += double(m.leafPairs.size()) / double(meetings.size());
  RegionSeparations separations;
  figures.separations = timed(options, meetings.size(), [&] {
    for (const Meeting& m : meetings)
      for (std::span<const NodePair> pairs = m.leafPairs; !pairs.empty();) {
        const auto some = pairs.first(std::min<std::size_t>(pairs.size(), RegionSeparations::kSize));
        measureSeparations(m.a.regions(), m.b.regions(), some, {0, limits.maxSeparation, limits.maxSeparation},
                           separations);
        pairs = pairs.subspan(some.size());
      }
  });
}

Figures measure(const SphereTree& tree, const Options& options) {
  std::mt19937_64 engine(options.seed);
  ContactKernel kernel;
  std::vector<Meeting> meetings;
  for (std::size_t i = 0; i < options.poses; ++i) meetings.push_back(meet(tree, engine, kernel));
  Figures figures;
  timeSpheres(options, meetings, limitsOf(tree), figures);
  Stages stages(tree, meetings);
  const auto time = [&](const auto& stage) { return timed(options, meetings.size(), stage); };
  figures.patches = time([&] { stages.findPatches(); });
  figures.features = time([&] { stages.listFeatures(); });
  figures.decisions = time([&] { stages.decide(); });
  figures.crossings = time([&] { stages.cross(); });
  figures.regions = time([&] { stages.findRegions(); });
  std::vector<KernelMemory> memories(meetings.size());
  figures.whole = time([&] {
    for (KernelMemory& memory : memories) memory.forget();
    stages.run(memories);
  });
  figures.carriedLists = time([&] { stages.run(memories); });
  stages.count(figures);
  return figures;
}

void print(const std::string& name, const Figures& f) {
  fmt::print(
      "{:<24} {:>9.0f} {:>8.2f} {:>6.2f} | {:>7.0f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} | {:>6.2f} {:>8.2f} "
      "{:>9.0f} | {:>8.1f} {}\n",
      name, f.leafPairs, f.traversal, f.separations, f.nearPatches, f.patches, f.features, f.decisions, f.crossings,
      f.regions, f.whole, f.carriedLists, 1e3 * f.whole / std::max(f.leafPairs, 1.0), f.contacts, f.hash);
}

nlohmann::json asJson(const std::string& name, const Figures& f) {
  return {{"tree", name},
          {"leaf_pairs", f.leafPairs},
          {"traversal_us", f.traversal},
          {"gaps_us", f.separations},
          {"near_patches", f.nearPatches},
          {"patches_us", f.patches},
          {"features_us", f.features},
          {"decisions_us", f.decisions},
          {"crossings_us", f.crossings},
          {"regions_us", f.regions},
          {"kernel_us", f.whole},
          {"kernel_lists_kept_us", f.carriedLists},
          {"contacts", f.contacts},
          {"hash", f.hash}};
}

int run(const Options& options) {
  fmt::print("Microseconds a pair of bodies that just touch, {} poses, medians of {} runs, seed {}.\n", options.poses,
             options.runs, options.seed);
  fmt::print("{:<24} {:>9} {:>8} {:>6} | {:>7} {:>8} {:>8} {:>8} {:>8} {:>8} | {:>6} {:>8} {:>9} | {:>8} hash\n",
             "tree", "leafpairs", "spheres", "gaps", "patches", "boxes", "features", "decide", "cross", "regions",
             "kernel", "kept", "ns/leafp.", "contacts");
  nlohmann::json json = nlohmann::json::array();
  for (const std::string& path : options.trees) {
    Result<SphereTree> tree = loadTree(path);
    if (!tree) {
      fmt::print(stderr, "kernel_bench: {}\n", tree.error().message);
      return 1;
    }
    const std::string name = std::filesystem::path(path).filename().string();
    const Figures figures = measure(tree.value(), options);
    print(name, figures);
    json.push_back(asJson(name, figures));
  }
  if (options.json.empty()) return 0;
  const Status written = writeFileAtomically(options.json, json.dump(2) + "\n");
  if (!written) fmt::print(stderr, "kernel_bench: {}\n", written.error().message);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  cairn::bench::Options options;
  CLI::App app("What the contact kernel costs, stage by stage, beside the spheres and their gaps.");
  app.add_option("TREE", options.trees, "sphere-trees (.cairn)")->required()->check(CLI::ExistingFile);
  app.add_option("--poses", options.poses, "pairs of bodies, each where it first touches")
      ->check(CLI::Range(1, 100000));
  app.add_option("--runs", options.runs, "of which the median is told")->check(CLI::Range(1, 1000));
  app.add_option("--seed", options.seed, "of the poses");
  app.add_option("--json", options.json, "write the figures to this file");
  app.footer("Example:\n  kernel_bench bunny.cairn torus.cairn --json kernel.json");
  CLI11_PARSE(app, argc, argv);
  return cairn::bench::run(options);
}
