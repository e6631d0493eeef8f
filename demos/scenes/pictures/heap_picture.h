// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "scenes/heap/heap.h"

namespace cairn::scenes {

/// A POV-Ray scene of a heap as it stands: the meshes (whatever shape they collided as) in their pit, its front walls
/// cut away.
std::string heapPicture(const Heap& heap);

}  // namespace cairn::scenes
