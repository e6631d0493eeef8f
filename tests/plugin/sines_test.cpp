// SPDX-License-Identifier: Zlib
#include "platform/sines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace cairn::bullet::sines_test {
namespace {

// Every 211th float, which meets all exponents, both signs, infinities and what is not a number.
constexpr std::uint64_t kStride = 211, kAllFloats = std::uint64_t{1} << 32;

float floatOf(std::uint64_t bits) {
  const auto word = static_cast<std::uint32_t>(bits);
  float value = 0;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

// In doubles, whose own error is far below what is allowed: 0.5607 units in the last place, as its source states.
TEST(Sines, AreWithinTheirStatedError) {
  constexpr double kUnits = 0.5607;
  for (std::uint64_t bits = 0; bits < kAllFloats; bits += kStride) {
    const float angle = floatOf(bits);
    if (!std::isfinite(angle)) {
      EXPECT_TRUE(std::isnan(platform::sine(angle)) && std::isnan(platform::cosine(angle)));
      continue;
    }
    for (const auto& [found, exact] : {std::pair(platform::sine(angle), std::sin(double(angle))),
                                       std::pair(platform::cosine(angle), std::cos(double(angle)))}) {
      const int exponent = exact == 0 ? -149 : std::max(std::ilogb(exact) - 23, -149);
      ASSERT_LE(std::abs(double(found) - exact), std::ldexp(kUnits, exponent)) << angle;
    }
  }
}

#if defined(__GLIBC__)
// The library may have been replaced where Cairn's dependencies are built from source; elsewhere this compares both.
TEST(Sines, HaveTheBitsOfTheGnuCLibrary) {
  const auto same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (std::uint64_t bits = 0; bits < kAllFloats; bits += kStride) {
    const float angle = floatOf(bits);
    ASSERT_TRUE(same(platform::sine(angle), std::sin(angle)) && same(platform::cosine(angle), std::cos(angle)))
        << angle;
  }
}
#endif

}  // namespace
}  // namespace cairn::bullet::sines_test
