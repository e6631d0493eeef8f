// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"

namespace cairn {

/// Receives each sentence of the log, without a line break. `message` is valid during the call. Any thread may call;
/// the function must not throw.
using LogFunction = void (*)(const char* message, void* user);

/// Sets where the log goes. Null, as at first, means standard error. The log has only the warnings that no return value
/// can carry, each at most once or per refused call. `user` is handed to the function as it is.
///
///     cairn::setLog([](const char* message, void*) { engine::warn(message); }, nullptr);
///
/// Call it before other threads use Cairn. Programs with a static Cairn in several libraries have a log in each.
CAIRN_CORE_EXPORT void setLog(LogFunction function, void* user);

/// Writes a sentence, without a line break, to the log.
CAIRN_CORE_EXPORT void logMessage(const char* message);

}  // namespace cairn
