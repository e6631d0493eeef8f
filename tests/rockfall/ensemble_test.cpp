// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <fstream>
#include <vector>

#include "prepared_scene.h"
#include "rockfall/ensemble/parts.h"
#include "rockfall/ensemble/run_folder.h"
#include "rockfall/ensemble/workers.h"
#include "rockfall/outputs/log_histogram.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall::ensemble_test {
namespace {

TEST(RunRange_Texts, AreReadOrRefused) {
  EXPECT_EQ(parseRange("3:10").value(), (RunRange{3, 10}));
  for (const char* wrong : {"", "5", "5:", ":5", "5:5", "6:5", "-1:5", "1:2:3", "a:b", "0:2000000000", "1 :2"})
    EXPECT_FALSE(parseRange(wrong)) << wrong;
  for (const char* wrong : {"", "0/3", "4/3", "3", "1/0", "1/3/5"}) EXPECT_FALSE(partOf({0, 10}, wrong)) << wrong;
}

TEST(RunRange_Parts, CoverTheWholeOnceAndEvenly) {
  for (const std::uint64_t count : {1, 7, 100, 1000})
    for (const int parts : {1, 3, 8}) {
      std::uint64_t next = 5;
      for (int part = 1; part <= parts; ++part) {
        const RunRange range = partOf({5, 5 + count}, std::to_string(part) + "/" + std::to_string(parts)).value();
        EXPECT_EQ(range.first, next);
        EXPECT_LE(range.last - range.first, count / static_cast<std::uint64_t>(parts) + 1);
        next = range.last;
      }
      EXPECT_EQ(next, 5 + count);
    }
}

TEST(LogHistogram_Quantiles, AreAtMostABinAboveTheSamples) {
  scenes::Random random(3);
  std::vector<double> sample;
  LogHistogram histogram;
  for (int i = 0; i < 1000; ++i) {
    sample.push_back(std::exp(random.uniform(-20, 20)));
    histogram.add(sample.back());
  }
  std::ranges::sort(sample);
  for (const std::uint32_t thousandths : {1U, 250U, 500U, 950U, 999U, 1000U}) {
    const double exact = sample[thousandths - 1];
    EXPECT_GE(histogram.quantile(thousandths), exact);
    // One part in 10^12 for the rounding of the bins' edges.
    EXPECT_LE(histogram.quantile(thousandths), exact * LogHistogram::kBinRatio * (1 + 1e-12));
  }
  EXPECT_EQ(histogram.quantile(1000), histogram.greatest());
}

TEST(LogHistogram_Bounds, AreThoseOfTheValuesAndABinWiderAtMost) {
  scenes::Random random(4);
  for (const int count : {1, 50, 71, 72, 1000}) {
    std::vector<double> values;
    LogHistogram histogram;
    for (int i = 0; i < count; ++i) {
      values.push_back(std::exp(random.uniform(0, 10)));
      histogram.add(values.back());
    }
    const Interval exact = Sample(values).confidence(950), found = histogram.bounds(confidenceRanks(count, 950));
    constexpr double kRounding = 1e-12;  // of the bins' edges
    EXPECT_LE(found.low, exact.low) << count;
    EXPECT_GE(found.low * LogHistogram::kBinRatio * (1 + kRounding), exact.low) << count;
    ASSERT_EQ(found.high.has_value(), exact.high.has_value()) << count;
    if (!exact.high) continue;
    EXPECT_GE(*found.high, *exact.high) << count;
    EXPECT_LE(*found.high, *exact.high * LogHistogram::kBinRatio * (1 + kRounding)) << count;
  }
}

TEST(LogHistogram_OfAMillionValues, IsNoLargerThanItsRange) {
  scenes::Random random(5);
  LogHistogram histogram;
  double sum = 0;
  constexpr int kValues = 1000000, kOctaves = 20;
  for (int i = 0; i < kValues; ++i) {
    const double value = std::exp2(random.uniform(0, kOctaves));
    sum += value;
    histogram.add(value);
  }
  EXPECT_EQ(histogram.count(), std::uint64_t(kValues));
  EXPECT_LE(histogram.bins(), 16U * kOctaves + 1);
  EXPECT_EQ(histogram.mean(), sum / kValues);
}

TEST(LogHistogram_Zeros, AreBelowEverything) {
  LogHistogram histogram;
  for (const double value : {0.0, 0.0, 0.0, 1e-300}) histogram.add(value);
  EXPECT_EQ(histogram.quantile(750), 0);
  EXPECT_EQ(histogram.quantile(1000), 1e-300);
  EXPECT_EQ(LogHistogram().quantile(500), 0);
}

TEST(Workers_Failing, GiveTheSentenceOfTheFirst) {
  EXPECT_TRUE(inProcesses(3, [](std::uint32_t) { return Status(); }));
  const Status failed = inProcesses(3, [](std::uint32_t worker) {
    return worker == 0 ? Status() : Status(Error{"worker " + std::to_string(worker)});
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "worker 1");
  const Status killed = inProcesses(1, [](std::uint32_t) -> Status {
    raise(SIGKILL);
    return {};
  });
  ASSERT_FALSE(killed);
  EXPECT_NE(killed.error().message.find("signal 9"), std::string::npos);
}

#ifdef __linux__
TEST(Workers_OfAProcessThatIsKilled, EndToo) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t starter = fork();
  if (starter == 0) {
    (void)inProcesses(3, [&](std::uint32_t) -> Status {
      (void)!write(ends[1], "w", 1);
      while (true) pause();
    });
    _exit(0);
  }
  close(ends[1]);
  const auto next = [&] {
    constexpr int kLongEnoughMs = 60000;  // for a loaded machine
    pollfd waiting{ends[0], POLLIN, 0};
    char c = 0;
    return poll(&waiting, 1, kLongEnoughMs) == 1 ? static_cast<int>(read(ends[0], &c, 1)) : -1;
  };
  for (int worker = 0; worker < 3; ++worker) ASSERT_EQ(next(), 1) << "they work";
  kill(starter, SIGKILL);
  EXPECT_EQ(next(), 0) << "nobody holds the pipe's other end any more";
  close(ends[0]);
  waitpid(starter, nullptr, 0);
}
#endif

/// Folders of runs of the plain case, shortened.
class RunFolders : public ::testing::Test {
 protected:
  RunFolders() : document_(test::plainCase()) {
    document_["duration_s"] = 0.5;
    document_["rocks"][0]["tree_depth"] = 1;
  }

  Result<EnsembleReport> compute(const char* name, const RunRange& runs) {
    return computeRuns(test::prepared(document_), document_, {runs, folder(name), 1}, {});
  }
  std::filesystem::path folder(const char* name) const { return temporary_.path() / name; }

  test::TemporaryFolder temporary_;
  nlohmann::json document_;
};

TEST_F(RunFolders, KeepEveryNumberOfARun) {
  ASSERT_TRUE(compute("a", {4, 5}));
  const RunFile file = readRunFile(folder("a") / runFileName(4)).value();
  const RunResult fresh = simulate(test::prepared(document_), 4).value().result;
  EXPECT_EQ(file.result.stateHash, fresh.stateHash);
  ASSERT_EQ(file.result.rocks.size(), fresh.rocks.size());
  for (std::size_t i = 0; i < fresh.rocks.size(); ++i) {
    EXPECT_EQ(file.result.rocks[i].end, fresh.rocks[i].end);
    EXPECT_EQ(file.result.rocks[i].maxEnergyJ, fresh.rocks[i].maxEnergyJ);
    EXPECT_EQ(file.result.trajectories[i].size(), fresh.trajectories[i].size());
    EXPECT_EQ(file.result.trajectories[i].back().place, fresh.trajectories[i].back().place);
  }
  EXPECT_EQ(file.result.cells.size(), fresh.cells.size());
}

TEST_F(RunFolders, ComputeOnlyWhatIsMissing) {
  EXPECT_EQ(compute("a", {0, 3}).value().computed, 3U);
  const EnsembleReport again = compute("a", {1, 5}).value();
  EXPECT_EQ(again.computed, 2U);
  EXPECT_EQ(again.kept, 2U);
  EXPECT_EQ(readManifest(folder("a")).value().asked, (RunRange{0, 5}));
}

TEST_F(RunFolders, OfAnotherCaseAreRefused) {
  ASSERT_TRUE(compute("a", {0, 1}));
  document_["seed"] = 2;
  const auto mixed = compute("a", {0, 1});
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().message.find("is of another case"), std::string::npos) << mixed.error().message;
  ASSERT_TRUE(compute("b", {0, 1}));
  const auto parts = Parts::open({folder("a"), folder("b")});
  ASSERT_FALSE(parts);
  EXPECT_NE(parts.error().message.find("of another case"), std::string::npos);
}

TEST_F(RunFolders, WithADamagedRunAreRefusedByItsName) {
  ASSERT_TRUE(compute("a", {0, 2}));
  const auto file = folder("a") / runFileName(1);
  const std::string good = test::contentOf(file);
  const std::size_t digit = good.find("\"steps\":") + 8;
  for (const std::string& bad : {good.substr(0, good.size() / 2), std::string(), std::string("[]"),
                                 good.substr(0, digit) + "9" + good.substr(digit + 1)}) {
    std::ofstream(file, std::ios::binary) << bad;
    const auto read = readRunFile(file);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("run-000000001.json is not a run as it was written"), std::string::npos);
    EXPECT_FALSE(compute("a", {0, 2}));
  }
}

TEST_F(RunFolders, WithoutAManifestAreRefused) {
  ASSERT_TRUE(compute("a", {0, 2}));
  std::filesystem::remove(folder("a") / kManifestName);
  const auto parts = Parts::open({folder("a")});
  ASSERT_FALSE(parts);
  EXPECT_NE(parts.error().message.find("is no folder of runs"), std::string::npos);
}

TEST(RunRange_Text, NamesTheRuns) {
  EXPECT_EQ(textOf({}), "");
  EXPECT_EQ(textOf({{3, 4}}), "3");
  EXPECT_EQ(textOf({{3, 4}, {10, 15}}), "3, 10 to 14");
  std::vector<RunRange> many;
  for (std::uint64_t run = 0; run < 40; run += 2) many.push_back({run, run + 1});
  EXPECT_EQ(textOf(many), "0, 2, 4, 6, 8, 10, 12, 14 and 12 more");
}

TEST_F(RunFolders, TellWhichRunsAreMissing) {
  ASSERT_TRUE(compute("a", {0, 3}));
  EXPECT_TRUE(Parts::open({folder("a")}).value().missing().empty());
  ASSERT_TRUE(compute("a", {5, 7}));
  EXPECT_EQ(Parts::open({folder("a")}).value().missing(), (std::vector<RunRange>{{3, 5}})) << "never asked for";
  ASSERT_TRUE(compute("b", {9, 10}));
  ASSERT_TRUE(std::filesystem::remove(folder("a") / runFileName(6)));
  const Parts parts = Parts::open({folder("b"), folder("a")}).value();
  EXPECT_EQ(parts.missing(), (std::vector<RunRange>{{3, 5}, {6, 9}})) << "one was lost";
  EXPECT_EQ(parts.runs(), (std::vector<RunRange>{{0, 3}, {5, 6}, {9, 10}}));
}

TEST_F(RunFolders, MayListSeveralRanges) {
  ASSERT_TRUE(compute("a", {0, 3}));
  const std::filesystem::path file = folder("a") / kManifestName;
  nlohmann::ordered_json manifest = nlohmann::ordered_json::parse(test::contentOf(file));
  EXPECT_EQ(manifest.at("runs"), nlohmann::ordered_json::parse("[[0, 3]]"));
  manifest["runs"] = {{0, 2}, {4, 6}};
  std::ofstream(file) << manifest.dump();
  EXPECT_EQ(readManifest(folder("a")).value().asked, (RunRange{0, 6}));
}

TEST_F(RunFolders, TellOfRunsThatWereAskedForAndNeverMade) {
  document_["duration_s"] = 1.5;  // a run asks whether to go on once in a hundred steps of 10 ms
  const auto computeTwoOf = [&](const RunRange& runs) {
    return computeRuns(test::prepared(document_), document_, {runs, folder("a"), 1},
                       [](std::uint64_t done, std::uint64_t) { return done < 2; });
  };
  ASSERT_FALSE(computeTwoOf({0, 5})) << "cancelled";
  EXPECT_EQ(Parts::open({folder("a")}).value().missing(), (std::vector<RunRange>{{2, 5}})) << "of a first request";
  ASSERT_FALSE(computeTwoOf({0, 9})) << "cancelled";
  EXPECT_EQ(Parts::open({folder("a")}).value().missing(), (std::vector<RunRange>{{4, 9}})) << "of a later one";
}

TEST_F(RunFolders, WithoutRunsBelongToNoSceneYet) {
  document_["duration_s"] = 1.5;  // as above
  ASSERT_FALSE(computeRuns(test::prepared(document_), document_, {{0, 2}, folder("a"), 1},
                           [](std::uint64_t, std::uint64_t) { return false; }))
      << "cancelled";
  document_["seed"] = 2;
  EXPECT_TRUE(compute("a", {0, 2}));
}

TEST_F(RunFolders, WithNonsenseForRunsAreRefused) {
  ASSERT_TRUE(compute("a", {0, 2}));
  const std::filesystem::path file = folder("a") / kManifestName;
  nlohmann::ordered_json manifest = nlohmann::ordered_json::parse(test::contentOf(file));
  for (const char* nonsense :
       {"[[0, 18446744073709551615]]", "[[0, 1000000001]]", "[[-5, 3]]", "[[0.5, 6.7]]", "[[0, 1e30]]", "[[5, 2]]",
        "[[0, 6, 9]]", "[]", "null", R"({"a": [0, 9]})", "5", R"("x")", R"([["a", 2]])", "[[0]]", "[[true, 6]]"}) {
    manifest["runs"] = nlohmann::ordered_json::parse(nonsense);
    std::ofstream(file) << manifest.dump();
    const auto read = readManifest(folder("a"));
    ASSERT_FALSE(read) << nonsense;
    EXPECT_NE(read.error().message.find("is no manifest of runs"), std::string::npos) << nonsense;
    EXPECT_FALSE(compute("a", {0, 2})) << nonsense;
  }
}

TEST_F(RunFolders, TellWhichPartsOfTheWholeAreMissing) {
  ASSERT_TRUE(computeRuns(test::prepared(document_), document_, {{1, 2}, folder("a"), 1, {0, 3}}, {}));
  EXPECT_EQ(Parts::open({folder("a")}).value().missing(), (std::vector<RunRange>{{0, 1}, {2, 3}}));
}

TEST_F(RunFolders, MayOverlapButNotDiffer) {
  ASSERT_TRUE(compute("a", {0, 3}));
  ASSERT_TRUE(compute("b", {2, 5}));
  const Parts parts = Parts::open({folder("b"), folder("a")}).value();
  std::vector<std::uint64_t> order;
  const auto note = [&](const RunFile& file) {
    order.push_back(file.result.run);
    return Status();
  };
  ASSERT_TRUE(parts.forEach(note));
  EXPECT_EQ(order, (std::vector<std::uint64_t>{0, 1, 2, 3, 4}));
  // A run with another result, whole in itself.
  FinishedRun other = simulate(test::prepared(document_), 2).value();
  other.result.steps += 1;
  ASSERT_TRUE(writeRunFile(folder("b"), parts.manifest().sceneHash, other));
  const Status differing = Parts::open({folder("a"), folder("b")}).value().forEach(note);
  ASSERT_FALSE(differing);
  EXPECT_NE(differing.error().message.find("differ"), std::string::npos);
}

}  // namespace
}  // namespace cairn::rockfall::ensemble_test
