// SPDX-License-Identifier: GPL-3.0-or-later
#include "lists.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <utility>

#include "scenes/world/priority_choice.h"

namespace cairn::frame_budget {
namespace {

using scenes::ShapeKind;

constexpr std::array kScenes{Scene::heap, Scene::crush, Scene::converge, Scene::rockfall};

Result<Scene> parseScene(const std::string& name) {
  const auto* const found = std::ranges::find(kScenes, name, sceneName);
  if (found == kScenes.end())
    return Error{fmt::format("there is no scene '{}': use heap, crush, converge or rockfall", name)};
  return *found;
}

Result<bullet::Unresolved> parseUnresolved(const std::string& name) {
  using bullet::Unresolved;
  static const std::map<std::string, Unresolved> kPolicies{{"guard", Unresolved::guard},
                                                           {"repel", Unresolved::repel},
                                                           {"ignore", Unresolved::ignore},
                                                           {"compensate", Unresolved::compensate}};
  const auto policy = kPolicies.find(name);
  if (policy != kPolicies.end()) return policy->second;
  return Error{
      fmt::format("there is no policy '{}' for unresolved pairs: use guard, repel, ignore or compensate", name)};
}

/// Each item as a change to the options of a combination.
using Choice = std::function<Status(Options&)>;
using Choices = std::vector<Choice>;

template <class Apply>
Choices choicesOf(const std::string& text, const Apply& apply) {
  Choices choices;
  for (const std::string& item : itemsOf(text))
    choices.push_back([item, apply](Options& options) { return apply(item, options); });
  return choices;
}

std::uint32_t defaultBodies(Scene scene) {
  return scene == Scene::heap || scene == Scene::rockfall ? 100 : 20;
}

/// Ten seconds of a simulation, five of a recording.
std::uint32_t defaultSteps(Scene scene) {
  switch (scene) {
    case Scene::converge:
      return 300;
    case Scene::rockfall:
      return 1200;
    default:
      return 600;
  }
}

Status setScene(const std::string& item, const std::optional<std::uint32_t>& steps, Options& options) {
  const auto scene = parseScene(item);
  if (!scene) return scene.error();
  options.scene = scene.value();
  options.heap.bodies = defaultBodies(options.scene);
  options.steps = steps.value_or(defaultSteps(options.scene));
  return {};
}

Status setMethod(const std::string& item, Options& options) {
  const auto method = builder::parseMethod(item);
  if (!method) return method.error();
  options.source.build.method = method.value();
  return {};
}

Status setPriority(const std::string& item, Options& options) {
  const auto priority = scenes::parsePriority(item);
  if (!priority) return priority.error();
  options.priority = item;
  options.heap.world.priority = priority.value();
  return {};
}

Status setUnresolved(const std::string& item, Options& options) {
  const auto policy = parseUnresolved(item);
  if (!policy) return policy.error();
  options.unresolved = item;
  options.heap.world.unresolved = policy.value();
  return {};
}

Status setShape(const std::string& item, Options& options) {
  const auto shape = scenes::parseShape(item);
  if (!shape) return shape.error();
  options.shapes = {shape.value()};
  return {};
}

/// Dimensions in the order of `combinationsOf`.
std::vector<Choices> allChoices(const ListTexts& texts, const std::optional<std::uint32_t>& steps) {
  return {choicesOf(texts.scenes, [steps](const auto& item, Options& o) { return setScene(item, steps, o); }),
          choicesOf(texts.bodies,
                    [](const auto& item, Options& o) {
                      o.heap.bodies = numberOf<std::uint32_t>(item).value_or(o.heap.bodies);
                      return Status();
                    }),
          choicesOf(texts.methods, setMethod),
          choicesOf(texts.shapes, setShape),
          choicesOf(texts.marginFractions,
                    [](const auto& item, Options& o) {
                      o.heap.shape.marginFraction = numberOf<double>(item);
                      return Status();
                    }),
          choicesOf(texts.maxContactErrors,
                    [](const auto& item, Options& o) {
                      o.heap.shape.maxContactError = numberOf<double>(item).value_or(o.heap.shape.maxContactError);
                      return Status();
                    }),
          choicesOf(texts.budgetOperations,
                    [](const auto& item, Options& o) {
                      o.heap.world.budget.operations = numberOf<std::int64_t>(item);
                      return Status();
                    }),
          choicesOf(texts.budgetMicroseconds,
                    [](const auto& item, Options& o) {
                      o.heap.world.budget.microseconds = numberOf<double>(item);
                      return Status();
                    }),
          choicesOf(texts.priorities, setPriority),
          choicesOf(texts.unresolved, setUnresolved)};
}
constexpr std::size_t kShapes = 3;

bool hasMargin(ShapeKind shape) {
  return shape == ShapeKind::gimpact || shape == ShapeKind::hull || shape == ShapeKind::compound;
}

/// True when a combination equals an earlier one in every option that its shape depends on. Other options count by
/// their first item alone.
bool isRepeated(ShapeKind shape, const std::vector<std::size_t>& chosen) {
  enum { scene, bodies, method, shapePlace, margin, contactError, operations, microseconds, priority, unresolved };
  const bool isTree = scenes::isSphereTree(shape);
  const auto isFirst = [&](std::size_t place) { return chosen[place] == 0; };
  if (!isTree && !(isFirst(operations) && isFirst(microseconds) && isFirst(priority) && isFirst(unresolved)))
    return true;
  if (!isTree && shape != ShapeKind::spheres && !isFirst(method)) return true;
  if (!isTree && !isFirst(contactError)) return true;
  return !hasMargin(shape) && !isFirst(margin);
}

/// Moves to the next combination, the last list first; false after the last one.
bool advance(std::vector<std::size_t>& chosen, const std::vector<Choices>& choices) {
  for (std::size_t place = chosen.size(); place-- > 0;) {
    if (++chosen[place] < choices[place].size()) return true;
    chosen[place] = 0;
  }
  return false;
}

/// Options that the shape does not depend on are not reported.
void leaveOutUnused(Options& options) {
  const ShapeKind shape = options.shapes.front();
  if (!scenes::isSphereTree(shape)) options.heap.world.budget = {};
  if (!scenes::isSphereTree(shape)) options.heap.shape.maxContactError = 0;
  if (!hasMargin(shape)) options.heap.shape.marginFraction.reset();
}

void complete(Options& options) {
  options.converge.bodies = options.heap.bodies;
  options.converge.frames = options.steps;
  options.converge.seed = options.heap.seed;
}

Result<std::vector<Options>> productOf(const std::vector<Choices>& choices, const Options& base) {
  std::vector<Options> list;
  std::vector<std::size_t> chosen(choices.size(), 0);
  do {
    Options options = base;
    for (std::size_t place = 0; place < choices.size(); ++place)
      if (Status applied = choices[place][chosen[place]](options); !applied) return applied.error();
    complete(options);
    const ShapeKind shape = options.shapes.front();
    const bool isPossible = shape != ShapeKind::fcl || options.scene == Scene::converge || choices[0].size() == 1;
    if (!isPossible || isRepeated(shape, chosen)) continue;
    list.push_back(std::move(options));
  } while (advance(chosen, choices));
  return list;
}

}  // namespace

std::vector<std::string> itemsOf(std::string_view text) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    items.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

std::function<std::string(const std::string&)> eachItem(std::function<std::string(const std::string&)> refuse) {
  return [refuse = std::move(refuse)](const std::string& text) {
    for (const std::string& item : itemsOf(text))
      if (std::string complaint = refuse(item); !complaint.empty()) return complaint;
    return std::string();
  };
}

Result<std::vector<Options>> combinationsOf(const ListTexts& texts, const Options& base,
                                            const std::optional<std::uint32_t>& steps) {
  std::vector<Choices> choices = allChoices(texts, steps);
  bool isSweep = false;
  for (std::size_t place = 0; place < choices.size(); ++place)
    isSweep = isSweep || (place != kShapes && choices[place].size() > 1);
  if (isSweep) {
    auto list = productOf(choices, base);
    if (!list) return list;
    if (list.value().empty()) return Error{"the shape fcl has no scene it can answer: use it with --scene converge"};
    for (Options& options : list.value()) leaveOutUnused(options);
    return list;
  }
  const Choices shapes = std::exchange(choices[kShapes], {[](Options& options) {
                                         options.shapes = {ShapeKind::tree};
                                         return Status();
                                       }});
  auto single = productOf(choices, base);
  if (!single) return single.error();
  std::vector<ShapeKind> kinds;
  for (const Choice& shape : shapes) {
    Options options;
    if (Status known = shape(options); !known) return known.error();
    kinds.push_back(options.shapes.front());
  }
  single.value().front().shapes = std::move(kinds);
  return single;
}

}  // namespace cairn::frame_budget
