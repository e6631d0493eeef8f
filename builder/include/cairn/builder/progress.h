// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>

namespace cairn::builder {

/// Told how far a long piece of work has come: which stage, and how much of the whole is done (0 to 1, never falling).
/// Returns false to cancel; the work then ends soon with the error "cancelled". May be called from any one thread at a
/// time.
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

/// Asked from any thread during long work; false once the caller wants it to end.
using KeepGoing = std::function<bool()>;

/// The message of the error a cancelled call returns.
inline constexpr std::string_view kCancelled = "cancelled";

}  // namespace cairn::builder
