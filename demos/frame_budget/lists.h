// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"

namespace cairn::frame_budget {

/// What stands between the commas; of an empty text, one empty item.
std::vector<std::string> itemsOf(std::string_view text);

/// The number the whole of a text is, in decimal; nothing for any other text, "none" among them.
template <class Number>
std::optional<Number> numberOf(std::string_view text) {
  Number value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

/// For `CLI::Option::check`: the first item that `refuse` has something to say about decides.
std::function<std::string(const std::string&)> eachItem(std::function<std::string(const std::string&)> refuse);

/// Options that may be lists, as texts. Their combinations are measured.
struct ListTexts {
  std::string scenes = "heap", shapes = "tree", bodies, budgetOperations, budgetMicroseconds, marginFractions,
              methods = "combined", priorities = "round-robin", unresolved = "guard";
};

/// The combinations of all items, in the order scenes, bodies, methods, shapes, margins, budgets, priorities, policies,
/// each with one shape; `steps`, where given, for all. A shape is not varied in what it does not depend on: budgets,
/// priorities and policies are the sphere-tree's, methods its and those of its spheres, margins those of GImpact, hulls
/// and compounds; and fcl only answers recorded poses. Where every list but that of the shapes has one item there is
/// one combination, with all shapes. Fails in one sentence for an item it does not know. Precondition: numbers have
/// been checked.
Result<std::vector<Options>> combinationsOf(const ListTexts& texts, const Options& base,
                                            const std::optional<std::uint32_t>& steps);

}  // namespace cairn::frame_budget
