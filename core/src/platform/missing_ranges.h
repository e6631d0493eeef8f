// SPDX-License-Identifier: Zlib
//
// Algorithms of <algorithm> that take ranges and projections, for standard libraries without them: libc++ before 15,
// which comes with Emscripten 3.1. The build includes this file before each source there (CairnTargets.cmake) and
// nowhere else. It has what Cairn's sources use, with the meaning the standard gives, except that arguments are not
// constrained. Adding to `std` is not portable, but this is for libraries that are fixed.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace std::ranges {

/// `less` on projected values, as the algorithms with iterators want it.
template <class Less, class Projection>
constexpr auto projected_less(Less& less, Projection& projection) {
  return [&](const auto& a, const auto& b) -> bool {
    return std::invoke(less, std::invoke(projection, a), std::invoke(projection, b));
  };
}

template <class Predicate, class Projection>
constexpr auto projected_test(Predicate& test, Projection& projection) {
  return [&](const auto& element) -> bool { return std::invoke(test, std::invoke(projection, element)); };
}

template <class Value, class Projection>
constexpr auto projected_equal(const Value& value, Projection& projection) {
  return [&](const auto& element) -> bool { return std::invoke(projection, element) == value; };
}

// Questions.

template <class Range, class Predicate, class Projection = std::identity>
constexpr bool any_of(Range&& range, Predicate test, Projection projection = {}) {
  return std::any_of(std::begin(range), std::end(range), ranges::projected_test(test, projection));
}

template <class Range, class Predicate, class Projection = std::identity>
constexpr bool all_of(Range&& range, Predicate test, Projection projection = {}) {
  return std::all_of(std::begin(range), std::end(range), ranges::projected_test(test, projection));
}

template <class Range, class Predicate, class Projection = std::identity>
constexpr bool none_of(Range&& range, Predicate test, Projection projection = {}) {
  return std::none_of(std::begin(range), std::end(range), ranges::projected_test(test, projection));
}

template <class Range, class Predicate, class Projection = std::identity>
constexpr auto count_if(Range&& range, Predicate test, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), ranges::projected_test(test, projection));
}

template <class Range, class Value, class Projection = std::identity>
constexpr auto count(Range&& range, const Value& value, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), ranges::projected_equal(value, projection));
}

template <class Range, class Other>
constexpr bool equal(const Range& range, const Other& other) {
  return std::equal(std::begin(range), std::end(range), std::begin(other), std::end(other));
}

template <class Range, class Other>
constexpr bool includes(const Range& range, const Other& other) {
  return std::includes(std::begin(range), std::end(range), std::begin(other), std::end(other));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr bool is_sorted(const Range& range, Less less = {}, Projection projection = {}) {
  return std::is_sorted(std::begin(range), std::end(range), ranges::projected_less(less, projection));
}

template <class Range, class Other, class Equal = std::equal_to<>, class P = std::identity, class Q = std::identity>
constexpr bool is_permutation(const Range& range, const Other& other, Equal equal = {}, P projection = {}, Q = {}) {
  static_assert(std::is_same_v<P, Q>);  // one projection serves both
  const auto same = [&](const auto& a, const auto& b) -> bool {
    return std::invoke(equal, std::invoke(projection, a), std::invoke(projection, b));
  };
  return std::is_permutation(std::begin(range), std::end(range), std::begin(other), std::end(other), same);
}

// Places.

template <class Range, class Value, class Projection = std::identity>
constexpr auto find(Range&& range, const Value& value, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), ranges::projected_equal(value, projection));
}

template <class Range, class Predicate, class Projection = std::identity>
constexpr auto find_if(Range&& range, Predicate test, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), ranges::projected_test(test, projection));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto min_element(Range&& range, Less less = {}, Projection projection = {}) {
  return std::min_element(std::begin(range), std::end(range), ranges::projected_less(less, projection));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto max_element(Range&& range, Less less = {}, Projection projection = {}) {
  return std::max_element(std::begin(range), std::end(range), ranges::projected_less(less, projection));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto min(Range&& range, Less less = {}, Projection projection = {}) {
  return *std::min_element(std::begin(range), std::end(range), ranges::projected_less(less, projection));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto minmax(Range&& range, Less less = {}, Projection projection = {}) {
  const auto found = std::minmax_element(std::begin(range), std::end(range), ranges::projected_less(less, projection));
  return std::pair(*found.first, *found.second);
}

template <class Range, class Value, class Less = std::less<>, class Projection = std::identity>
constexpr auto lower_bound(Range&& range, const Value& value, Less less = {}, Projection projection = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](const auto& element, const auto& wanted) {
    return std::invoke(less, std::invoke(projection, element), wanted);
  });
}

template <class Range, class Value, class Less = std::less<>, class Projection = std::identity>
constexpr auto upper_bound(Range&& range, const Value& value, Less less = {}, Projection projection = {}) {
  return std::upper_bound(std::begin(range), std::end(range), value, [&](const auto& wanted, const auto& element) {
    return std::invoke(less, wanted, std::invoke(projection, element));
  });
}

template <class Range, class Value>
constexpr bool binary_search(const Range& range, const Value& value) {
  return std::binary_search(std::begin(range), std::end(range), value);
}

// Changes.

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr void sort(Range&& range, Less less = {}, Projection projection = {}) {
  std::sort(std::begin(range), std::end(range), ranges::projected_less(less, projection));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
constexpr void stable_sort(Range&& range, Less less = {}, Projection projection = {}) {
  std::stable_sort(std::begin(range), std::end(range), ranges::projected_less(less, projection));
}

template <class Iterator>
struct rest {
  Iterator first, last;
  constexpr Iterator begin() const { return first; }
  constexpr Iterator end() const { return last; }
};

template <class Range, class Equal = std::equal_to<>, class Projection = std::identity>
constexpr auto unique(Range&& range, Equal equal = {}, Projection projection = {}) {
  const auto last = std::unique(std::begin(range), std::end(range), ranges::projected_less(equal, projection));
  return rest<decltype(last)>{last, std::end(range)};
}

template <class Range, class Value>
constexpr void fill(Range&& range, const Value& value) {
  std::fill(std::begin(range), std::end(range), value);
}

template <class Range, class From, class To>
constexpr void replace(Range&& range, const From& from, const To& to) {
  for (auto& element : range)
    if (element == from) element = to;
}

template <class Range, class Function>
constexpr void for_each(Range&& range, Function function) {
  for (auto&& element : range) std::invoke(function, element);
}

template <class Range, class Output>
constexpr void copy(Range&& range, Output output) {
  std::copy(std::begin(range), std::end(range), output);
}

template <class Range, class Output, class Predicate>
constexpr void copy_if(Range&& range, Output output, Predicate test) {
  std::copy_if(std::begin(range), std::end(range), output, test);
}

template <class Range, class Generator>
void shuffle(Range&& range, Generator&& generator) {
  std::shuffle(std::begin(range), std::end(range), generator);
}

struct permuted {
  bool found;
};

template <class Range>
constexpr permuted next_permutation(Range&& range) {
  return {std::next_permutation(std::begin(range), std::end(range))};
}

}  // namespace std::ranges
