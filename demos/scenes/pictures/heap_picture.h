// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "scenes/heap/heap.h"

namespace cairn::scenes {

/// Returns a POV-Ray scene of a heap's current poses: the meshes (whatever shape they collided as) in their pit,
/// without its front walls.
std::string heapPicture(const Heap& heap);

}  // namespace cairn::scenes
