// SPDX-License-Identifier: GPL-3.0-or-later
//
// How flat and smooth bodies stand, slide and roll as sphere-trees, beside Bullet's own shapes and the textbook, in one
// run. The trees are built from generated solids.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "still/bodies.h"

namespace cairn::bench {
namespace {

using test::Slope;
using test::Solid;
using test::TriedBody;

constexpr double kGravity = 9.81;

struct Options {
  std::string json;
  std::string only;
  int stackSeconds = 20, stacks = 9;
  std::vector<int> iterations{30};
};

/// One line of the table: an experiment, what theory says of it, and what each shape did.
struct Row {
  std::string experiment;
  std::optional<double> theory;
  std::vector<std::pair<std::string, double>> measured;  // by shape
  nlohmann::ordered_json details;
};

class Table {
 public:
  void add(Row row) {
    fmt::print("{:46}{:>9}", row.experiment, row.theory ? fmt::format("{:.3f}", *row.theory) : "-");
    for (const auto& [shape, value] : row.measured) fmt::print("{:>11.3f}", value);
    if (row.theory) fmt::print("{:>+9.1f} %", 100 * (row.measured.front().second / *row.theory - 1));
    fmt::print("\n");
    std::fflush(stdout);
    rows_.push_back(std::move(row));
  }
  static void title(const std::string& what) {
    fmt::print("\n{:46}{:>9}{:>11}{:>11}{:>11}{:>11}{:>11}\n", what, "theory", "tree", "own", "hull", "gimpact",
               "tree is off");
  }
  nlohmann::ordered_json json() const {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Row& row : rows_) {
      nlohmann::ordered_json object{{"experiment", row.experiment}};
      object["theory"] = row.theory ? nlohmann::ordered_json(*row.theory) : nullptr;
      for (const auto& [shape, value] : row.measured) object["measured"][shape] = value;
      object["details"] = row.details;
      json.push_back(object);
    }
    return json;
  }

 private:
  std::vector<Row> rows_;
};

Solid cylinder(double radius, double length, int sides, int bands) {
  std::vector<std::array<double, 2>> profile{{0, -length / 2}};
  for (int i = 0; i <= bands; ++i) profile.push_back({radius, length * (double(i) / bands - 0.5)});
  profile.push_back({0, length / 2});
  return test::revolved(profile, sides);
}

// Least, quartiles and most of every figure.
nlohmann::ordered_json detailsOf(const std::vector<test::StackRun>& stacks) {
  const auto spread = [&](double test::StackRun::*figure) {
    nlohmann::ordered_json values;
    for (const double fraction : {0.0, 0.25, 0.5, 0.75, 1.0})
      values.push_back(test::quantile(stacks, figure, fraction));
    return values;
  };
  return {{"drift_m", spread(&test::StackRun::drift)},
          {"settling_m", spread(&test::StackRun::settling)},
          {"kinetic_energy_j", spread(&test::StackRun::energy)}};
}

Status measureStacks(const Options& options, Table& table) {
  constexpr double kEdge = 1;
  const auto cube =
      tryShapes(test::cuboid({kEdge, kEdge, kEdge}, 1), "cube", std::make_shared<btBoxShape>(btVector3(0.5, 0.5, 0.5)));
  if (!cube) return cube.error();
  Table::title(fmt::format("ten cubes of 1 m: drift, mm, median of {}", options.stacks));
  for (const int iterations : options.iterations)
    for (const double aside : {0.0, 0.001, 0.005, 0.02}) {
      Row row{fmt::format("stack, {} iterations, placed {} mm aside", iterations, 1000 * aside), {}, {}, {}};
      const test::StackStart start{
          .seconds = options.stackSeconds, .iterations = iterations, .edge = kEdge, .aside = btScalar(aside)};
      for (const auto& [name, body] : cube.value().shapes) {
        const std::vector<test::StackRun> runs = test::runStacks(body, start, options.stacks);
        row.measured.emplace_back(name, 1000 * test::quantile(runs, &test::StackRun::drift, 0.5));
        row.details[name] = detailsOf(runs);
      }
      table.add(std::move(row));
    }
  return {};
}

struct Ground {
  std::string name;
  std::shared_ptr<btCollisionShape> shape;
  btScalar top;  // over its origin
};

void measureSlope(const std::string& name, const TriedShapes& bodies, double theory, const Slope& slope, Table& table) {
  Row row{name, theory, {}, {}};
  for (const auto& [shape, body] : bodies.shapes) {
    const test::SlopeRun run = test::runSlope(body, slope);
    row.measured.emplace_back(shape, run.acceleration);
    row.details[shape] = {{"acceleration", run.acceleration}, {"slip", run.slip}, {"aside_m", run.aside}};
  }
  table.add(std::move(row));
}

Result<std::vector<Ground>> grounds() {
  constexpr double kLength = 12, kWidth = 2, kHeight = 0.4;
  const auto box = std::make_shared<btBoxShape>(btVector3(kLength / 2, kWidth / 2, kHeight / 2));
  const auto slab = tryShapes(test::cuboid({kLength, kWidth, kHeight}, 1), "slab", box);
  if (!slab) return slab.error();
  return std::vector<Ground>{{"a plane", std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), 0},
                             {"a box", box, kHeight / 2},
                             {"a slab's tree", slab.value().ours().shape, kHeight / 2}};
}

double slidingTheory(const Slope& slope) {
  const double angle = slope.degrees * std::numbers::pi / 180;
  return kGravity * (std::sin(angle) - double(slope.friction) * std::cos(angle));
}

Status measureSlides(Table& table) {
  const auto block = tryShapes(test::cuboid({1, 0.3, 0.3}, 1), "block",
                               std::make_shared<btBoxShape>(btVector3(0.5, btScalar(0.15), btScalar(0.15))));
  if (!block) return block.error();
  const auto cube =
      tryShapes(test::cuboid({1, 1, 1}, 1), "cube", std::make_shared<btBoxShape>(btVector3(0.5, 0.5, 0.5)));
  if (!cube) return cube.error();
  const auto on = grounds();
  if (!on) return on.error();
  Table::title("sliding, friction 0.3, 30 degrees: m/s2");
  for (const Ground& ground : on.value()) {
    Slope slope{.degrees = 30,
                .friction = btScalar(0.3),
                .ground = ground.shape,
                .top = ground.top,
                .height = btScalar(0.15),
                .uphill = 4};
    measureSlope("a block on " + ground.name, block.value(), slidingTheory(slope), slope, table);
    slope.turned = btQuaternion(btVector3(0, 0, 1), btScalar(std::numbers::pi / 2));
    measureSlope("a block across " + ground.name, block.value(), slidingTheory(slope), slope, table);
  }
  Slope twin{.degrees = 30,
             .friction = btScalar(0.3),
             .ground = cube.value().ours().shape,
             .top = btScalar(0.5),
             .height = btScalar(0.5),
             .uphill = btScalar(0.3)};
  twin.fromStep = 6;
  twin.toStep = 36;
  measureSlope("a cube on its fixed twin's tree", cube.value(), slidingTheory(twin), twin, table);
  return {};
}

double rollingTheory(const Slope& slope, double moment) {
  const double angle = slope.degrees * std::numbers::pi / 180;
  return kGravity * std::sin(angle) / (1 + moment / (slope.radius * slope.radius));
}

constexpr double kRadius = 0.2, kLength = 0.8;

// Down every ground, its axis `axis` of the mesh across the slope.
void rollOn(const std::vector<Ground>& on, const std::string& name, const TriedShapes& body, int axis, Table& table) {
  const btQuaternion across(btVector3(1, 0, 0), btScalar(std::numbers::pi / 2));
  for (const Ground& ground : on) {
    const Slope slope{.ground = ground.shape,
                      .top = ground.top,
                      .height = btScalar(kRadius),
                      .uphill = 4,
                      .turned = across,
                      .radius = kRadius};
    measureSlope(name + " on " + ground.name, body, rollingTheory(slope, body.moment(axis)), slope, table);
  }
}

Status measureRolls(Table& table) {
  const auto on = grounds();
  if (!on) return on.error();
  Table::title("rolling, friction 1, 10 degrees: m/s2");
  for (const int sides : {32, 64, 128}) {
    const auto body = tryShapes(cylinder(kRadius, kLength, sides, sides == 32 ? 8 : 1), "cylinder",
                                std::make_shared<btCylinderShapeZ>(btVector3(kRadius, kRadius, kLength / 2)));
    if (!body) return body.error();
    rollOn(on.value(), fmt::format("a cylinder of {} sides", sides), body.value(), 2, table);
  }
  for (const int subdivisions : {10, 16}) {
    const auto body =
        tryShapes(test::ball(kRadius, subdivisions), "ball", std::make_shared<btSphereShape>(btScalar(kRadius)));
    if (!body) return body.error();
    rollOn(on.value(), fmt::format("a ball of {} triangles", 8 * subdivisions * subdivisions), body.value(), 0, table);
  }
  return {};
}

Status measure(const Options& options) {
  Table table;
  const auto isAsked = [&](const char* what) { return options.only.empty() || options.only == what; };
  if (isAsked("slide"))
    if (Status status = measureSlides(table); !status) return status;
  if (isAsked("roll"))
    if (Status status = measureRolls(table); !status) return status;
  if (isAsked("stack"))
    if (Status status = measureStacks(options, table); !status) return status;
  return options.json.empty() ? Status() : writeFileAtomically(options.json, table.json().dump(2) + "\n");
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  cairn::bench::Options options;
  CLI::App app("How flat and smooth bodies stand, slide and roll as sphere-trees, beside Bullet's own shapes.",
               "still_bench");
  app.add_option("--only", options.only, "stack, slide or roll")->check(CLI::IsMember({"stack", "slide", "roll"}));
  app.add_option("--stack-seconds", options.stackSeconds, "how long the stacks are to stand")->capture_default_str();
  app.add_option("--stacks", options.stacks, "how many are to stand, their cubes placed a little differently")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--iterations", options.iterations, "of the solver under stacks; several with commas")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--json", options.json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  const cairn::Status status = cairn::bench::measure(options);
  if (status) return 0;
  fmt::print(stderr, "still_bench: {}\n", status.error().message);
  return 1;
}
