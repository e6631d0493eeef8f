// SPDX-License-Identifier: Zlib
//
// Takes the place of the C library's functions in the program that links it, Bullet's calls of them included.
#include "platform/sines.h"

extern "C" float sinf(float angle) {
  return cairn::bullet::platform::sine(angle);
}

extern "C" float cosf(float angle) {
  return cairn::bullet::platform::cosine(angle);
}
