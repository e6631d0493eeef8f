// SPDX-License-Identifier: Zlib
#include "cairn/core/state_hash.h"

namespace cairn {

std::string StateHash::hex() const {
  std::string text(16, '0');
  for (int digit = 0; digit < 16; ++digit) text[digit] = "0123456789abcdef"[(value_ >> (60 - 4 * digit)) & 0xF];
  return text;
}

}  // namespace cairn
