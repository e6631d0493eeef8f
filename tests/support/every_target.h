// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "cairn/core/family.h"

namespace cairn::test {

/// For tests of what is compiled once per instruction set: each of those the machine has in turn.
class EveryTarget : public testing::Test {
 protected:
  void TearDown() override { choose(0); }

  template <class Check>
  static void onEveryTarget(Check check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      choose(target);
      SCOPED_TRACE(simdTargetName());
      check();
      if (HasFatalFailure()) return;
    }
  }

 private:
  // 0: whatever is best again.
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

}  // namespace cairn::test
