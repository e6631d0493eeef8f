// SPDX-License-Identifier: Zlib
//
// The cost of effects that do nothing: a set without effects against no set, and each effect listed with nothing to act
// on against no set, as parts of a step's CPU time. All worlds go through the same states (checked), a few steps each
// in turn, so that each ratio is of neighbours in time; medians of the ratios. "again" is a second world without a set:
// what the machine adds of its own.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "cairn/core/atomic_file.h"
#include "cpu_seconds.h"
#include "every_effect.h"

namespace cairn::bench {
namespace {

using nlohmann::ordered_json;

struct Options {
  int bodies = 500, rounds = 60, stepsPerRound = 10, warmUp = 240;
  std::string json;
};

constexpr btScalar kStep = btScalar(1) / 120;

/// Balls and boxes dropped onto level ground, or flying where nothing touches.
class Crowd {
 public:
  Crowd(int bodies, bool flies, bool hasSet) {
    if (hasSet) set_ = effects::EffectSet::create(w_.world).value();
    if (flies) w_.world.setGravity(btVector3(0, 0, 0));
    btRigidBody& ground = w_.addGround();
    if (set_) set_->describe(ground, {.material = test::kSoil});
    const auto ball = std::make_shared<btSphereShape>(btScalar(0.5));
    const auto box = std::make_shared<btBoxShape>(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.3)));
    // Columns of five, so close that they fall into one heap; in the air a body's width apart.
    const int width = std::max(1, static_cast<int>(std::sqrt(bodies / 5.0)));
    const btScalar apart = flies ? btScalar(3) : btScalar(1.1);
    for (int i = 0; i < bodies; ++i) {
      const int column = i / 5;
      const btVector3 place(apart * btScalar(column % width) + btScalar(0.1) * btScalar(i % 3),
                            apart * btScalar(column / width) + btScalar(0.1) * btScalar(i % 2),
                            1 + apart * btScalar(i % 5));
      btRigidBody& body = i % 2 == 0 ? w_.add(ball, 1, place) : w_.add(box, 1, place);
      body.setActivationState(DISABLE_DEACTIVATION);
      if (flies) body.setAngularVelocity(btVector3(0, 0, 1));
      if (set_) set_->addBody(body, {.material = test::kRock, .volume = btScalar(0.5)});
    }
  }

  void add(std::unique_ptr<effects::Effect> effect) { set_->add(std::move(effect)); }
  /// CPU seconds.
  double run(int steps) {
    const double start = cpuSeconds();
    for (int i = 0; i < steps; ++i) w_.world.stepSimulation(kStep, 1, kStep);
    return cpuSeconds() - start;
  }
  std::uint64_t stateHash() const { return w_.stateHash(); }
  /// In the hooks of its effects, for the whole run.
  double hookMicroseconds() const {
    double sum = 0;
    if (set_)
      for (const effects::EffectReport& report : set_->report()) sum += report.elapsedMicroseconds;
    return sum;
  }

 private:
  test::BulletWorld<> w_;
  std::unique_ptr<effects::EffectSet> set_;
};

struct Row {
  std::string name;
  std::unique_ptr<Crowd> crowd;
  std::vector<double> ratios;  // to the world without a set, round by round
};

std::vector<Row> rowsOf(const Options& options, bool flies) {
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, bool hasSet) -> Crowd& {
    rows.push_back({name, std::make_unique<Crowd>(options.bodies, flies, hasSet), {}});
    return *rows.back().crowd;
  };
  add("no set", false);
  add("again", false);
  add("empty set", true);
  for (const test::EffectRow& row : test::everyEffect())
    if (row.idle) add(row.name, true).add(row.idle());
  return rows;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// Whether all worlds ended in the same state.
bool measure(const Options& options, bool flies, ordered_json& json) {
  std::vector<Row> rows = rowsOf(options, flies);
  std::vector<double> steps;
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  for (Row& row : rows) row.crowd->run(options.warmUp);
  for (int round = 0; round < options.rounds; ++round) {
    std::vector<double> times(rows.size());
    for (const std::size_t i : order) times[i] = rows[i].crowd->run(options.stepsPerRound);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].ratios.push_back(times[i] / times[0]);
    steps.push_back(1e6 * times[0] / options.stepsPerRound);
    // The one that comes first must not always be the same: it finds the caches as another world left them.
    std::ranges::rotate(order, order.begin() + 1);
  }
  const double step = median(steps);
  fmt::print("{} {}: a step takes {:.0f} us\n{:24}{:>12}{:>16}\n", options.bodies, flies ? "in the air" : "in a heap",
             step, "", "% of a step", "% in its hooks");
  const int allSteps = options.warmUp + options.rounds * options.stepsPerRound;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double cost = 100 * (median(rows[i].ratios) - 1);
    const double hooks = 100 * rows[i].crowd->hookMicroseconds() / allSteps / step;
    fmt::print("{:24}{:>12.2f}{:>16.2f}\n", rows[i].name, cost, hooks);
    json.push_back({{"scene", flies ? "air" : "heap"},
                    {"bodies", options.bodies},
                    {"step_us", step},
                    {"idle", rows[i].name},
                    {"percent_of_step", cost},
                    {"percent_in_hooks", hooks}});
  }
  return std::ranges::all_of(rows,
                             [&](const Row& row) { return row.crowd->stateHash() == rows[0].crowd->stateHash(); });
}

Status run(const Options& options) {
  ordered_json json = ordered_json::array();
  for (const bool flies : {false, true})
    if (!measure(options, flies, json)) return Error{"an effect with nothing to act on changed the simulation"};
  return options.json.empty() ? Status() : writeFileAtomically(options.json, json.dump(2) + "\n");
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("What effects cost that are not listed, or listed with nothing to act on.", "effects_bench");
  cairn::bench::Options options;
  app.add_option("--bodies", options.bodies, "balls and boxes")->check(CLI::Range(1, 100000));
  app.add_option("--rounds", options.rounds, "how often each world has its turn")->check(CLI::Range(1, 100000));
  app.add_option("--steps", options.stepsPerRound, "of a turn")->check(CLI::Range(1, 100000));
  app.add_option("--warm-up", options.warmUp, "steps before")->check(CLI::Range(0, 100000));
  app.add_option("--json", options.json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  const cairn::Status status = cairn::bench::run(options);
  if (status) return 0;
  fmt::print(stderr, "effects_bench: {}\n", status.error().message);
  return 1;
}
