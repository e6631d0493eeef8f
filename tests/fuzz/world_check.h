// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bytes.h"

namespace cairn::fuzz {

/// A Bullet world as the bytes say: bodies, poses, budgets, policies, and what happens to them step by step. After each
/// step nothing but what was made no number is none, contacts lie between bodies that live, trees state errors that
/// brute force confirms, and what a step may cost it costs; played twice, it ends in the same bits.
void checkWorld(Bytes bytes);

}  // namespace cairn::fuzz
