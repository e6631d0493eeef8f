// SPDX-License-Identifier: Zlib
#pragma once

// The instruction sets Highway compiles for; to be included before any header of Highway. `family-inl.h` keeps vectors
// in structures, which those of scalable length cannot be kept in: such machines take NEON.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
