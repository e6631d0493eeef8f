// SPDX-License-Identifier: Zlib
//
// Sphere tests per second of whole traversals, beside what the machine can do at most: the same family blocks in the
// same order through the same test. One thread, CPU time, medians of interleaved runs, on every instruction set of the
// machine. Ends with 1 when a traversal's leaf pairs are not the reference's.
#include <fmt/format.h>
#include <hwy/targets.h>
#include <stdlib.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "cairn/core/atomic_file.h"
#include "cairn/core/state_hash.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/tree_pair_traversal.h"
#include "cpu_seconds.h"
#include "traversal/cases.h"
#include "traversal/streams.h"

namespace cairn::bench {
namespace {

struct Options {
  std::string tree, json;
  std::size_t poses = 100, runs = 9;
  double runMs = 20;
  std::uint64_t seed = 1;
};

/// Sphere tests per second in units of a million, on one instruction set.
struct Rates {
  std::string target;
  double stream = 0, moved = 0, traversal = 0;
  std::string hash;

  double ofStream() const { return traversal / stream; }
  double ofMoved() const { return traversal / moved; }
};

/// Something that makes all tests of a case once, as often as needed for a run of the wished length.
template <class Work>
class RepeatedWork {
 public:
  RepeatedWork(Work work, double seconds) : work_(std::move(work)) {
    const double once = std::max(timed(1), 1e-9);
    repeats_ = static_cast<std::size_t>(seconds / once) + 1;
  }
  void run() { seconds_.push_back(timed(repeats_) / static_cast<double>(repeats_)); }
  double median() {
    std::sort(seconds_.begin(), seconds_.end());
    return seconds_[seconds_.size() / 2];
  }

 private:
  double timed(std::size_t repeats) {
    const double start = cpuSeconds();
    for (std::size_t i = 0; i < repeats; ++i) {
      volatile std::uint64_t proofOfWork = work_();
      (void)proofOfWork;
    }
    return cpuSeconds() - start;
  }

  Work work_;
  std::size_t repeats_ = 1;
  std::vector<double> seconds_;
};

class CaseBench {
 public:
  explicit CaseBench(const TraversalCase& c) : case_(c) {}

  Rates measure(const Options& options) {
    const double seconds = 1e-3 * options.runMs;
    RepeatedWork stream([&] { return streamFamilies(case_, case_.tree->sphere(kRootNode)); }, seconds);
    RepeatedWork moved([&] { return streamSteps(case_); }, seconds);
    RepeatedWork traversal([&] { return traverseAll(nullptr); }, seconds);
    for (std::size_t run = 0; run < options.runs; ++run) {
      stream.run();
      moved.run();
      traversal.run();
    }
    StateHash hash;
    (void)traverseAll(&hash);
    const double tests = 1e-6 * static_cast<double>(case_.sphereTests);
    return {simdTargetName(), tests / stream.median(), tests / moved.median(), tests / traversal.median(), hash.hex()};
  }

 private:
  std::uint64_t traverseAll(StateHash* hash) {
    std::uint64_t found = 0;
    for (const Pose& pose : case_.poses) {
      traversal_.start(*case_.tree, *case_.tree, {}, pose, case_.margin);
      Budget budget = Budget::unlimited();
      (void)traversal_.refine(budget);
      found += traversal_.leafPairs().size();
      if (hash != nullptr)
        for (const NodePair& pair : traversal_.leafPairs()) hash->add(std::uint64_t{pair.a} << 32 | pair.b);
    }
    return found;
  }

  const TraversalCase& case_;
  TreePairTraversal traversal_;
};

std::vector<Rates> onEveryTarget(CaseBench& bench, const Options& options) {
  std::vector<Rates> rows;
  std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::reverse(targets.begin(), targets.end());
  for (const std::int64_t target : targets) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    rows.push_back(bench.measure(options));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return rows;
}

/// Load of the machine over the last minute: runnable processes.
double machineLoad() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

nlohmann::ordered_json toJson(const TraversalCase& c, const std::vector<Rates>& rows) {
  nlohmann::ordered_json json{{"case", c.name},
                              {"leaves", c.tree->leafCount()},
                              {"poses", c.poses.size()},
                              {"family_tests", c.families.size()},
                              {"sphere_tests", c.sphereTests},
                              {"reference_hash", c.hash}};
  for (const Rates& r : rows)
    json["targets"].push_back({{"target", r.target},
                               {"stream_sphere_tests_per_us", r.stream},
                               {"stream_moved_sphere_tests_per_us", r.moved},
                               {"traversal_sphere_tests_per_us", r.traversal},
                               {"traversal_of_stream_ratio", r.ofStream()},
                               {"traversal_of_stream_moved_ratio", r.ofMoved()},
                               {"hash", r.hash}});
  return json;
}

void print(const TraversalCase& c, const std::vector<Rates>& rows) {
  fmt::print("\n{}: {} leaves, {} poses, {} family tests, {} sphere tests\n", c.name, c.tree->leafCount(),
             c.poses.size(), c.families.size(), c.sphereTests);
  fmt::print("          million sphere tests/s                    traversal of\n");
  fmt::print("{:<8} {:>8} {:>13} {:>10} {:>9} {:>13}  hash\n", "", "stream", "stream+move", "traversal", "stream",
             "stream+move");
  for (const Rates& r : rows)
    fmt::print("{:<8} {:8.0f} {:13.0f} {:10.0f} {:8.0f} % {:11.0f} %  {}{}\n", r.target, r.stream, r.moved, r.traversal,
               100 * r.ofStream(), 100 * r.ofMoved(), r.hash, r.hash == c.hash ? "" : "  WRONG, should be " + c.hash);
}

Result<std::vector<TraversalCase>> casesFor(const Options& options) {
  std::vector<TraversalCase> cases;
  if (!options.tree.empty()) {
    Result<SphereTree> tree = loadTree(options.tree);
    if (!tree) return tree.error();
    const auto shared = std::make_shared<const SphereTree>(std::move(tree).value());
    cases.push_back(makeCase(options.tree, shared, options.poses, options.seed));
    return cases;
  }
  for (const std::uint32_t leaves : {512U, 4096U})
    cases.push_back(makeCase("ring", ringTree(leaves), options.poses, options.seed));
  // Its blocks and nodes are too many for the second level of today's caches.
  cases.push_back(makeCase("cloud", cloudTree(1U << 18), std::max<std::size_t>(options.poses / 50, 1), options.seed));
  return cases;
}

int run(const Options& options) {
  const Result<std::vector<TraversalCase>> cases = casesFor(options);
  if (!cases) {
    fmt::print(stderr, "traversal_bench: {}\n", cases.error().message);
    return 1;
  }
  const double load = machineLoad();
  fmt::print("one thread, CPU time, median of {} runs of {} ms; load of the machine {:.1f} on {} CPUs; seed {}\n",
             options.runs, options.runMs, load, sysconf(_SC_NPROCESSORS_ONLN), options.seed);
  nlohmann::ordered_json json{
      {"load", load}, {"runs", options.runs}, {"run_ms", options.runMs}, {"seed", options.seed}};
  bool isRight = true;
  for (const TraversalCase& c : cases.value()) {
    CaseBench bench(c);
    const std::vector<Rates> rows = onEveryTarget(bench, options);
    print(c, rows);
    json["cases"].push_back(toJson(c, rows));
    isRight &= std::all_of(rows.begin(), rows.end(), [&](const Rates& r) { return r.hash == c.hash; });
  }
  if (options.json.empty()) return isRight ? 0 : 1;
  const Status written = writeFileAtomically(options.json, json.dump(2) + "\n");
  if (!written) fmt::print(stderr, "traversal_bench: {}\n", written.error().message);
  return isRight && written ? 0 : 1;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("Sphere tests per second of whole traversals, and of the same blocks merely streamed.",
               "traversal_bench");
  cairn::bench::Options options;
  app.add_option("TREE", options.tree,
                 "A .cairn file; generated ones of 512, 4096 and about 118000 leaves when left out");
  app.add_option("--poses", options.poses, "Random overlapping poses")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Of which the median is printed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--run-ms", options.runMs, "Least length of a run")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Of the poses")->capture_default_str();
  app.add_option("--json", options.json, "Write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  return cairn::bench::run(options);
}
