// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include "installed_dispatchers.h"

namespace cairn::test {

struct FrontEndName {
  template <class T>
  static std::string GetName(int) {
    if (std::is_same_v<T, InstalledOnDispatcher>) return "InstalledOnDispatcher";
    return std::is_same_v<T, InstalledOnWorld> ? "InstalledOnWorld" : "Dispatcher";
  }
};
using EveryFrontEnd = testing::Types<bullet::Dispatcher<>, InstalledOnDispatcher, InstalledOnWorld>;
/// Those that know where a step ends.
using StepFrontEnds = testing::Types<bullet::Dispatcher<>, InstalledOnWorld>;

}  // namespace cairn::test

/// A suite whose tests, `TYPED_TEST(suite, name)`, run behind each of `FrontEnds` in turn, as `TypeParam`.
#define CAIRN_FRONT_END_SUITE(suite, FrontEnds) \
  template <class T>                            \
  class suite : public testing::Test {};        \
  TYPED_TEST_SUITE(suite, FrontEnds, cairn::test::FrontEndName)
