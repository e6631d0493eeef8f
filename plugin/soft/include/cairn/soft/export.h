// SPDX-License-Identifier: Zlib
// What a shared library of soft bodies shows.
#pragma once

#include "cairn/core/export.h"

#if defined(cairn_soft_EXPORTS)
#define CAIRN_SOFT_EXPORT CAIRN_EXPORTED
#else
#define CAIRN_SOFT_EXPORT CAIRN_IMPORTED
#endif
