// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"

/// The version of these headers. The one place where it stands: the build reads it from here.
#define CAIRN_VERSION_MAJOR 0
#define CAIRN_VERSION_MINOR 1
#define CAIRN_VERSION_PATCH 0

#define CAIRN_QUOTE_(x) #x
#define CAIRN_QUOTE(x) CAIRN_QUOTE_(x)
/// As "0.1.0".
#define CAIRN_VERSION \
  CAIRN_QUOTE(CAIRN_VERSION_MAJOR) "." CAIRN_QUOTE(CAIRN_VERSION_MINOR) "." CAIRN_QUOTE(CAIRN_VERSION_PATCH)

namespace cairn {

/// `CAIRN_VERSION` of the library that is linked: another than that of the headers is a mistake of the installation.
CAIRN_CORE_EXPORT const char* version();

}  // namespace cairn
