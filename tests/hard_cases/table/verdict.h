// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hard_case.h"

namespace cairn::hard {

/// `asGoodAsStock`: beyond what was asked, as Bullet's best own shape is on the same case, which is no better than we
/// are: physics or Bullet forbids more. `misses`: beyond what was asked, and a shape of Bullet's does better or none
/// could be asked.
enum class Verdict { holds, asGoodAsStock, misses };

Verdict verdictOn(const Measure& measure);
/// Holds, and a shape of Bullet's is nearer to what was asked, or farther within it.
bool holdsBehindStock(const Measure& measure);
/// The worst of its measures; a case without measures misses.
Verdict verdictOn(const Outcome& outcome);
std::string nameOf(Verdict verdict);

}  // namespace cairn::hard
