// SPDX-License-Identifier: Zlib
#include "cairn/core/version.h"

namespace cairn {

const char* version() {
  return CAIRN_VERSION;
}

}  // namespace cairn
