// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/frame_time.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "accuracy_cost/experiments/statistics.h"
#include "accuracy_cost/experiments/tree_fit.h"
#include "scenes/heap/crush_run.h"
#include "scenes/heap/heap.h"

namespace cairn::accuracy_cost {
namespace {

using scenes::ShapeKind;

constexpr double kBodySize = 1, kStepsPerSecond = 60;
/// The limit for the slowest step in a thousand: this factor of the budget, plus the time of an empty step.
constexpr double kAllowance = 1.10;
/// A shape's slowest step in a thousand is a spike above this multiple of its median.
constexpr double kSpike = 3;
constexpr std::array kShapes{ShapeKind::tree, ShapeKind::gimpact, ShapeKind::hull, ShapeKind::compound};

FrameTimeExtent extentOf(const Settings& settings) {
  FrameTimeExtent extent;
  if (!settings.quick) return extent;
  extent.heapBodies = 40;
  extent.steps = 150;
  extent.heapBudgetUs = 500;
  return extent;
}

/// One scene of one mesh; all shapes start alike.
struct Setting {
  const char* name;
  scenes::HeapOptions options;
  double budgetUs;
};

Result<std::vector<Setting>> settingsOf(const scenes::Model& model, const FrameTimeExtent& extent, std::uint64_t seed) {
  std::vector<Setting> list(2);
  list[0] = {"heap", {}, extent.heapBudgetUs};
  list[0].options.bodies = extent.heapBodies;
  list[1] = {"crush", {}, extent.crushBudgetUs};
  list[1].options.bodies = extent.crushBodies;
  const auto start = scenes::crushStart(model, extent.crushBodies, seed);
  if (!start) return start.error();
  list[1].options.start = start.value().poses;
  for (Setting& setting : list) {
    setting.options.seed = seed;
    setting.options.world.sleeping = false;
  }
  return list;
}

/// One run of one shape; empty for a shape this build has no library for.
Result<std::vector<double>> runOf(const scenes::Model& model, const Setting& setting, ShapeKind shape,
                                  std::uint32_t steps) {
  scenes::HeapOptions options = setting.options;
  options.world.shape = shape;
  if (scenes::isSphereTree(shape)) options.world.budget.microseconds = setting.budgetUs;
  auto heap = scenes::Heap::create(model, options);
  if (!heap && shape == ShapeKind::compound) return std::vector<double>();
  if (!heap) return heap.error();
  std::vector<double> times;
  for (std::uint32_t step = 0; step < steps; ++step) times.push_back(heap.value()->step().narrowPhaseCpuUs);
  return times;
}

/// Median time (us) of the tree's step without any work.
Result<double> emptyStep(const scenes::Model& model, const Setting& setting) {
  scenes::HeapOptions options = setting.options;
  options.start.resize(options.bodies, btTransform::getIdentity());  // it moves them apart
  return scenes::measureEmptyStep(model, options);
}

Status measureSetting(const std::string& name, const scenes::Model& model, const Setting& setting,
                      const FrameTimeExtent& extent, Steps& steps, Table& table) {
  const auto empty = emptyStep(model, setting);
  if (!empty) return empty.error();
  const double allowance = kAllowance * setting.budgetUs + empty.value();
  for (std::uint32_t run = 1; run <= extent.repetitions; ++run)
    for (const ShapeKind shape : kShapes) {
      if (!steps.next(fmt::format("{}, {} of {}, run {}", name, setting.name, scenes::shapeName(shape), run)))
        return Error{std::string(builder::kCancelled)};
      const auto times = runOf(model, setting, shape, extent.steps);
      if (!times) return times.error();
      const bool isOurs = scenes::isSphereTree(shape);
      for (std::size_t step = 0; step < times.value().size(); ++step)
        table.add(name, setting.name, scenes::shapeName(shape), isOurs ? "ours" : "rival", run, step + 1,
                  static_cast<double>(step + 1) / kStepsPerSecond, times.value()[step], setting.budgetUs,
                  isOurs ? fmt::format("{}", allowance) : std::string());
    }
  return {};
}

Result<Table> measure(const std::vector<Model>& models, const Settings& settings,
                      const builder::ProgressCallback& progress) {
  return measureFrameTime(models, extentOf(settings), settings.seed, progress);
}

/// The time of one shape over one scene: of each run, and its medians over the runs.
struct Course {
  std::string shape;
  bool isOurs = false;
  double budget = 0, allowance = 0;  ///< the tree's, us
  MedianInterval slowest{};          ///< the slowest step in a thousand, us
  MedianInterval overBudget{},
      overMedian{};       ///< the slowest step divided by the tree's budget, and by the shape's own median
  MedianInterval late{};  ///< steps, %, that take longer than the tree's allowance
};

std::vector<Course> coursesOf(const Table& table, const std::string& model, const std::string& scene) {
  const double allowance = table.value("allowance_us", {{"model", model}, {"scene", scene}, {"side", "ours"}});
  std::vector<Course> courses;
  for (const std::string& shape : table.texts("shape", {{"model", model}, {"scene", scene}})) {
    const Where where{{"model", model}, {"scene", scene}, {"shape", shape}};
    Course course{.shape = shape,
                  .isOurs = table.texts("side", where).front() == "ours",
                  .budget = table.value("budget_us", where),
                  .allowance = allowance};
    std::vector<double> slowest, overBudget, overMedian, late;
    for (const std::string& run : table.texts("run", where)) {
      Where ofRun = where;
      ofRun.emplace_back("run", run);
      const std::vector<double> times = table.numbers("narrow_phase_us", ofRun);
      const scenes::Quantiles q = scenes::quantilesOf(times);
      slowest.push_back(q.p999);
      overBudget.push_back(q.p999 / course.budget);
      overMedian.push_back(q.p999 / q.median);
      const auto over = std::ranges::count_if(times, [&](double time) { return time > allowance; });
      late.push_back(100.0 * static_cast<double>(over) / static_cast<double>(times.size()));
    }
    course.slowest = medianOf(std::move(slowest));
    course.overBudget = medianOf(std::move(overBudget));
    course.overMedian = medianOf(std::move(overMedian));
    course.late = medianOf(std::move(late));
    courses.push_back(std::move(course));
  }
  return courses;
}

std::string intervalText(const MedianInterval& m) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", m.median, m.low, m.high);
}

std::string microsecondsText(const MedianInterval& m) {
  return fmt::format("{:.0f} ({:.0f} to {:.0f}) µs", m.median, m.low, m.high);
}

/// The rule of all claims, as one clause.
std::string courseText(const Course& course) {
  return fmt::format(
      "the slowest step in a thousand takes {}, {} times its median and {} times the budget of {:.0f} µs; {} % of "
      "the steps take longer than the tree is allowed",
      microsecondsText(course.slowest), intervalText(course.overMedian), intervalText(course.overBudget), course.budget,
      intervalText(course.late));
}

/// A model in a scene.
struct Place {
  std::string model, scene;
  std::string name() const { return fmt::format("{} of {}", scene, model); }
};

/// Returns a claim of our own about one place; nothing of its scope can be left out.
Claim claimAt(const Place& place, Claim claim, double figure) {
  claim.scope = {.reach = Reach::every, .models = {place.model}};
  claim.figure = figure;
  claim.isOwn = true;
  return claim;
}

Claim budgetClaim(const Place& place, const Course& ours) {
  const double share = ours.slowest.median / ours.allowance;
  return claimAt(place,
                 {fmt::format("ours keeps its budget in {}", place.name()),
                  fmt::format("its slowest step in a thousand takes at most {} times the budget and an empty step, "
                              "median of the runs",
                              kAllowance),
                  fmt::format("tree in {}: {}; the slowest in a thousand is {} of what is allowed", place.name(),
                              courseText(ours), ratioText(share, 1)),
                  share <= 1},
                 share);
}

/// Measures all shapes alike: the slowest step over the own median.
Claim steadyClaim(const Place& place, const Course& ours) {
  const double ratio = ours.overMedian.median;
  return claimAt(place,
                 {fmt::format("ours does not spike in {}", place.name()),
                  fmt::format("its slowest step in a thousand takes less than {} times its own median, median of the "
                              "runs",
                              kSpike),
                  fmt::format("tree in {}: {}", place.name(), courseText(ours)), ratio < kSpike},
                 ratio);
}

Claim spikeClaim(const Place& place, const Course& rival, const Course* ours) {
  const double ratio = rival.overMedian.median;
  std::string found = fmt::format("{} in {}: {}", rival.shape, place.name(), courseText(rival));
  if (ours != nullptr) found += fmt::format("; ours by the same measure: {} times", intervalText(ours->overMedian));
  return claimAt(place,
                 {fmt::format("{} spikes in {}", rival.shape, place.name()),
                  fmt::format("its slowest step in a thousand takes at least {} times its own median, median of the "
                              "runs",
                              kSpike),
                  std::move(found), ratio >= kSpike},
                 ratio);
}

void judgeScene(const Place& place, const std::vector<Course>& courses, std::vector<Claim>& claims) {
  const auto found = std::ranges::find_if(courses, &Course::isOurs);
  const Course* const ours = found == courses.end() ? nullptr : &*found;
  for (const Course& course : courses) {
    if (!course.isOurs) {
      claims.push_back(spikeClaim(place, course, ours));
      continue;
    }
    claims.push_back(budgetClaim(place, course));
    claims.push_back(steadyClaim(place, course));
  }
}

std::vector<Figure> draw(const Table& table) {
  Figure figure{
      "frame-time", "The narrow phase step by step: ours on a budget beside Bullet's own shapes (first run)", 2, {}};
  const auto shapes = table.texts("shape");
  for (const std::string& model : table.texts("model"))
    for (const std::string& scene : table.texts("scene")) {
      Panel panel{
          fmt::format("{}, {}", model, scene), "time_s", {"simulated time, s"}, {"narrow phase, µs a step", true}, {}};
      for (unsigned i = static_cast<unsigned>(shapes.size()); i-- > 0;) {
        const Where where{{"model", model}, {"scene", scene}, {"shape", shapes[i]}, {"run", "1"}};
        panel.series.push_back({shapes[i], where, "narrow_phase_us", {i, 0, 0, true, false}});
      }
      panel.series.push_back({"budget of the tree",
                              {{"model", model}, {"scene", scene}, {"side", "ours"}, {"run", "1"}},
                              "budget_us",
                              {4, 0, 1, true, false}});
      figure.panels.push_back(std::move(panel));
    }
  return {figure};
}

}  // namespace

Result<Table> measureFrameTime(const std::vector<Model>& models, const FrameTimeExtent& extent, std::uint64_t seed,
                               const builder::ProgressCallback& progress) {
  Table table(
      {"model", "scene", "shape", "side", "run", "step", "time_s", "narrow_phase_us", "budget_us", "allowance_us"});
  Steps steps(progress, models.size() * (1 + 2 * std::size_t{extent.repetitions} * kShapes.size()));
  for (const Model& model : models) {
    if (!steps.next(model.name + ", tree")) return Error{std::string(builder::kCancelled)};
    auto tree = provenTree(model.mesh,
                           {.depth = extent.depth, .seed = seed, .optimiser = std::nullopt, .balance = std::nullopt},
                           steps.inside());
    if (!tree) return about(model.name, tree.error());
    const scenes::Model body =
        scenes::makeModel(std::make_shared<const SphereTree>(std::move(tree).value()), kBodySize);
    const auto settings = settingsOf(body, extent, seed);
    if (!settings) return about(model.name, settings.error());
    for (const Setting& setting : settings.value())
      if (Status status = measureSetting(model.name, body, setting, extent, steps, table); !status)
        return status.error();
  }
  return table;
}

std::vector<Claim> judgeFrameTime(const Table& table) {
  std::vector<Claim> claims;
  for (const std::string& model : table.texts("model"))
    for (const std::string& scene : table.texts("scene", {{"model", model}}))
      judgeScene({model, scene}, coursesOf(table, model, scene), claims);
  return claims;
}

Experiment frameTimeExperiment() {
  return {"frame-time",
          "the narrow phase's time step by step, ours on a budget of microseconds",
          "1.1, 2.7 and 7.2, beyond its figures",
          "Interruptible collision detection keeps a frame's time whatever happens in it: ours is to be flat at its "
          "budget where other shapes spike. The thesis counts operations and shows no frame times.",
          "Simulated, each shape its own course: a heap that falls into a pit, and bodies that start deep in each "
          "other. Trees and GImpact (margin 0.1 %) on planes, hulls and HACD's compounds (margin 1 %, no slower here "
          "than less) on boxes, each on what "
          "suits it. No body sleeps. Every run is repeated shape by shape in turn; quantiles are those of each run (of "
          "fewer "
          "than a thousand steps the slowest in a thousand is the slowest), then the median over the runs with a "
          "distribution-free interval of 95 %. Spikes are told of all shapes, ours too, by the slowest over their own "
          "median. "
          "Only the tree has a budget; the others' times are told over the same. "
          "Time is CPU time of the dispatch. Budgets in microseconds are not reproducible to the bit: nor is this "
          "table.",
          {"bunny"},
          {"bunny"},
          measure,
          judgeFrameTime,
          draw,
          true};
}

}  // namespace cairn::accuracy_cost
