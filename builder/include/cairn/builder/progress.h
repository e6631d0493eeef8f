// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>

namespace cairn::builder {

/// Receives the progress of long work: the stage, and the fraction of the whole that is done (0 to 1, never falling). A
/// return value of false cancels the work, which then ends soon with the error `kCancelled`. Calls may come from any
/// thread, but never from two at a time.
///
///     const auto progress = [&](std::string_view stage, double done) { return show(stage, done) && !interrupted; };
///     auto tree = buildTree(mesh, options, progress);
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

/// Asked from any thread during long work; returns false once the work should end.
using KeepGoing = std::function<bool()>;

/// The message of the error that a cancelled call returns.
inline constexpr std::string_view kCancelled = "cancelled";

}  // namespace cairn::builder
