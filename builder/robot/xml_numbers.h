// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// As many finite numbers as the array holds, between white space, and nothing else. Independent of the locale.
template <std::size_t N>
std::optional<std::array<double, N>> numbersOf(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::array<double, N> numbers{};
  for (double& number : numbers) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.empty() && kSpace.find(text.front()) == std::string_view::npos) return std::nullopt;
  }
  if (text.find_first_not_of(kSpace) != std::string_view::npos) return std::nullopt;
  return numbers;
}

}  // namespace cairn::builder
