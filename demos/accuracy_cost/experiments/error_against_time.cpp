// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/error_against_time.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "accuracy_cost/experiments/contest.h"
#include "accuracy_cost/experiments/error_against_time_claims.h"
#include "accuracy_cost/experiments/tree_fit.h"

namespace cairn::accuracy_cost {
namespace {

using scenes::ShapeKind;

constexpr double kBodySize = 1;
/// The value at which a figure with a logarithmic axis shows smaller errors, as a fraction of body size.
constexpr double kMinDrawn = 1e-4;

ContestExtent extentOf(const Settings& settings) {
  ContestExtent extent;
  extent.converge = {
      .bodies = 20, .runs = settings.quick ? 1U : 3U, .frames = settings.quick ? 240U : 300U, .seed = settings.seed};
  extent.heap = {.bodies = settings.quick ? 20U : 50U, .frames = settings.quick ? 60U : 120U, .seed = settings.seed};
  extent.truthEvery = settings.quick ? 10 : 5;
  extent.repetitions = settings.quick ? 6 : 9;
  extent.isFine = !settings.quick;
  return extent;
}

/// The trees of one mesh, as models for the players.
class Trees {
 public:
  Trees(const Model& model, std::uint64_t seed, Steps& steps) : model_(model), seed_(seed), steps_(steps) {}

  Result<const scenes::Model*> make(builder::Method method, unsigned depth) {
    const std::string what = fmt::format("{}, {} of {} levels", model_.name, builder::methodName(method), depth);
    if (!steps_.next(what)) return Error{std::string(builder::kCancelled)};
    auto tree = provenTree(
        model_.mesh,
        {.method = method, .depth = depth, .seed = seed_, .optimiser = std::nullopt, .balance = std::nullopt},
        steps_.inside());
    if (!tree) return about(what, tree.error());
    models_.push_back(std::make_unique<scenes::Model>(
        scenes::makeModel(std::make_shared<const SphereTree>(std::move(tree).value()), kBodySize)));
    if (models_.back()->vertices != models_.front()->vertices)
      return about(what, Error{"the tree's body frame is not that of the others"});
    return models_.back().get();
  }

 private:
  const Model& model_;
  std::uint64_t seed_;
  Steps& steps_;
  std::vector<std::unique_ptr<scenes::Model>> models_;
};

using Budgets = std::vector<std::optional<std::int64_t>>;

void addTrees(std::vector<Contender>& list, Contender like, const Budgets& budgets) {
  like.isOurs = true;
  for (const auto& operations : budgets) {
    like.operations = operations;
    list.push_back(like);
  }
}

// At margins from one down to none: with a margin more pairs meet, and earlier.
void addRivals(std::vector<Contender>& list, const scenes::Model* finest, const std::string& method, unsigned depth) {
  const auto add = [&](const char* series, ShapeKind shape, std::optional<double> margin) {
    list.push_back({series, shape, "", 0, {}, margin, false, finest});
  };
  add("GImpact without margin", ShapeKind::gimpact, 0);
  add("GImpact at a margin of 0.1 %", ShapeKind::gimpact, 0.001);
  add("GImpact at a margin of 1 %", ShapeKind::gimpact, 0.01);
  add("hull without margin", ShapeKind::hull, 0);
  add("hull at a margin of 0.1 %", ShapeKind::hull, 0.001);
  add("hull at a margin of 1 %", ShapeKind::hull, 0.01);
  add("compound of hulls (HACD) without margin", ShapeKind::compound, 0);
  add("compound of hulls (HACD) at a margin of 0.1 %", ShapeKind::compound, 0.001);
  add("compound of hulls (HACD) at a margin of 1 %", ShapeKind::compound, 0.01);
  list.push_back({"compound of the tree's leaf spheres", ShapeKind::spheres, method, depth, {}, {}, false, finest});
  add("FCL", ShapeKind::fcl, {});
}

Result<std::vector<Contender>> contendersOf(Trees& trees, const ContestExtent& extent) {
  using builder::Method;
  std::vector<Contender> list;
  const auto finest = trees.make(Method::combined, extent.depth);
  if (!finest) return finest.error();
  const Budgets budgets = extent.isFine ? Budgets{{}, 32000, 16000, 8000, 4000, 2000, 1000, 500}
                                        : Budgets{{}, 16000, 8000, 4000, 2000, 1000};
  const Budgets triangleBudgets =
      extent.isFine ? Budgets{{}, 64000, 32000, 16000, 8000, 4000, 2000} : Budgets{{}, 32000, 16000, 8000, 4000};
  const std::string depthName = fmt::format("{} levels", extent.depth);
  addTrees(list,
           {.series = "tree of " + depthName + " by budget",
            .method = "combined",
            .depth = extent.depth,
            .model = finest.value()},
           budgets);
  addTrees(list,
           {.series = "tree + triangles by budget",
            .shape = ShapeKind::treeTriangles,
            .method = "combined",
            .depth = extent.depth,
            .model = finest.value()},
           triangleBudgets);
  for (unsigned depth = extent.depth; depth-- > 1;) {
    const auto coarse = trees.make(Method::combined, depth);
    if (!coarse) return coarse.error();
    addTrees(list, {.series = "tree of fewer levels", .method = "combined", .depth = depth, .model = coarse.value()},
             {{}});
  }
  if (extent.isFine) {
    const auto adaptive = trees.make(Method::adaptive, extent.depth);
    if (!adaptive) return adaptive.error();
    addTrees(list,
             {.series = "tree of adaptive by budget",
              .method = "adaptive",
              .depth = extent.depth,
              .model = adaptive.value()},
             {{}, 16000, 4000});
  }
  addRivals(list, finest.value(), "combined", extent.depth);
  return list;
}

std::string cell(const std::optional<std::int64_t>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}
std::string cell(const std::optional<double>& value) {
  return value ? cellOf(*value) : std::string();
}

void addRow(Table& table, const std::string& model, const char* scene, const Contender& c, const Outcome& o,
            const ContestExtent& extent) {
  const auto& a = o.accuracy;
  table.add(model, scene, c.series, scenes::shapeName(c.shape), c.method,
            c.depth > 0 ? fmt::format("{}", c.depth) : std::string(), cell(c.operations), cell(c.margin),
            c.isOurs ? "ours" : "rival", a.frames, a.meanPairError, a.pairError.p99, a.pairError.max,
            std::max(a.meanPairError, kMinDrawn), std::max(a.pairError.p99, kMinDrawn), a.meanError, a.error.p99,
            a.error.max, a.truePairs, a.reportedPairs, a.reportedPairs + a.missed, a.missed, a.meanMissed,
            a.deepestMissed, a.missedBeyondCertificate, a.falseGap.pairs, a.falseGap.mean, a.falseGap.max,
            scenes::isSphereTree(c.shape) ? cellOf(o.certifiedError) : std::string(),
            scenes::isSphereTree(c.shape) ? fmt::format("{}", o.operations) : std::string(), extent.repetitions,
            o.timeUs.median, o.timeUs.low, o.timeUs.high, o.timeOverReference.median, o.timeOverReference.low,
            o.timeOverReference.high);
}

Status measureModel(const Model& model, const ContestExtent& extent, std::uint64_t seed, Steps& steps, Table& table) {
  Trees trees(model, seed, steps);
  const auto contenders = contendersOf(trees, extent);
  if (!contenders) return contenders.error();
  const scenes::Model& body = *contenders.value().front().model;
  for (const char* scene : {"converge", "heap"}) {
    const std::string what = fmt::format("{}, {}", model.name, scene);
    const auto tell = [&](double fraction) { return steps.inside()("", fraction); };
    if (!steps.next(what + " recorded")) return Error{std::string(builder::kCancelled)};
    const bool isHeap = std::string_view(scene) == "heap";
    const auto recording =
        isHeap ? scenes::recordHeap(body, extent.heap, tell) : scenes::recordConverge(body, extent.converge);
    if (!recording) return about(what, recording.error());
    if (!steps.next(what)) return Error{std::string(builder::kCancelled)};
    const auto outcomes =
        holdContest(recording.value(), contenders.value(), extent.truthEvery, extent.repetitions, tell);
    if (!outcomes) return about(what, outcomes.error());
    for (std::size_t i = 0; i < outcomes.value().size(); ++i)
      if (const auto& outcome = outcomes.value()[i])
        addRow(table, model.name, scene, contenders.value()[i], *outcome, extent);
  }
  return {};
}

Result<Table> measure(const std::vector<Model>& models, const Settings& settings,
                      const builder::ProgressCallback& progress) {
  return measureErrorAgainstTime(models, extentOf(settings), settings.seed, progress);
}

std::vector<Figure> draw(const Table& table) {
  Figure mean{"error-against-time", "Error against time: all shapes on the same recorded poses", 2, {}};
  Figure worst{"error-against-time-p99", "Error of 99 % of the pairs against time", 2, {}};
  const auto series = table.texts("series");
  for (auto* const figure : {&mean, &worst})
    for (const std::string& model : table.texts("model"))
      for (const std::string& scene : table.texts("scene")) {
        const bool isMean = figure == &mean;
        Panel panel{fmt::format("{}, {}", model, scene),
                    isMean ? "error_mean_drawn_fraction" : "error_p99_drawn_fraction",
                    {isMean ? "mean error of a pair, % of size (less: at 0.01)"
                            : "error of 99 % of the pairs, % of size (less: at 0.01)",
                     true, 100},
                    {"narrow phase, µs a frame", true},
                    {}};
        for (unsigned i = 0; i < series.size(); ++i) {
          const Where where{{"model", model}, {"scene", scene}, {"series", series[i]}};
          const bool isOurs = table.texts("side", where) == std::vector<std::string>{"ours"};
          panel.series.push_back({series[i], where, "time_us", {i, i, 0, isOurs}});
        }
        figure->panels.push_back(std::move(panel));
      }
  return {mean, worst};
}

}  // namespace

Result<Table> measureErrorAgainstTime(const std::vector<Model>& models, const ContestExtent& extent, std::uint64_t seed,
                                      const builder::ProgressCallback& progress) {
  Table table({"model",
               "scene",
               "series",
               "shape",
               "method",
               "depth",
               "budget_operations",
               "margin_fraction",
               "side",
               "frames_checked",
               "error_mean_fraction",
               "error_p99_fraction",
               "error_max_fraction",
               "error_mean_drawn_fraction",
               "error_p99_drawn_fraction",
               "point_error_mean_fraction",
               "point_error_p99_fraction",
               "point_error_max_fraction",
               "meeting_pairs",
               "reported_pairs",
               "error_pairs",
               "missed_pairs",
               "missed_depth_mean_fraction",
               "missed_depth_max_fraction",
               "missed_beyond_certificate",
               "false_pairs",
               "false_gap_mean_fraction",
               "false_gap_max_fraction",
               "certified_error_mean_fraction",
               "operations_median",
               "repetitions",
               "time_us",
               "time_low_us",
               "time_high_us",
               "time_over_tree",
               "time_over_tree_low",
               "time_over_tree_high"});
  const std::size_t trees = extent.depth + (extent.isFine ? 1 : 0);
  Steps steps(progress, models.size() * (trees + 4));
  for (const Model& model : models)
    if (Status status = measureModel(model, extent, seed, steps, table); !status) return status.error();
  return table;
}

Experiment errorAgainstTimeExperiment() {
  return {
      "error-against-time",
      "error against microseconds: every shape on the same recorded poses",
      "2.7 and 7.2, beyond its figures",
      "Interruptible collision detection trades accuracy for speed: with more time, the error falls. The thesis "
      "measures no microseconds and no rival.",
      "Poses are recorded once, of bodies that collide as exact meshes (GImpact): bodies that fly to one point, and "
      "a heap without its pit. All shapes are shown them in turn, as often as the column repetitions says. Error "
      "of a point: how far the point a contact gives for either body is from that body's mesh, the farther of "
      "the two, by the exact check. The rules go by the error of a pair (columns error_...), each pair that meets or "
      "has contacts once: a pair that meets and has no contact errs by its penetration, any other by its worst point, "
      "and by its gap if it does not meet and that is more. The mean is over both kinds together (their number is "
      "the column error_pairs): a pair counts once however many points it has, but many pairs that are reported and "
      "apart, or reported well, do make a missed one count for less. Of fewer than 100 pairs the 99 % quantile is the "
      "greatest error. Points alone, missed pairs and gaps have columns of their own. Time: CPU time of "
      "the dispatch, mean over the frames; the median of the repetitions with a distribution-free interval of "
      "95 % of what they are like in one run: another run, on a machine that does something else, can lie outside. "
      "Time over the tree's is formed in each repetition before its median is taken. Columns of errors are "
      "the same bits on every run, columns of time are not. Bodies are 1 m across. Each shape has the contact points "
      "its library makes: FCL's one point stands for both bodies (it lies on one of them; the other is as far off as "
      "the contact is deep), and Bullet keeps points of its own shapes up to 2 % of a body apart, ours 0.2 %. How deep "
      "a contact says it is, and its normal, are not judged.",
      {"bunny", "dragon", "torus"},
      {"bunny"},
      measure,
      judgeErrorAgainstTime,
      draw,
      true};
}

}  // namespace cairn::accuracy_cost
