// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bytes.h"

namespace cairn::fuzz {

/// A traversal of two trees as the bytes say: trees, poses, margin, and where it is stopped. Stopped or not it has to
/// find the same, spend no more than it is given, leave nothing out that touches by brute force, and name nothing that
/// is farther apart than it states.
void checkBareTraversal(Bytes& bytes);

}  // namespace cairn::fuzz
