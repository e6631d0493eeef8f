// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cairn::tool {

/// From now on the first SIGINT or SIGTERM is noted instead of ending the program, so that work in progress can stop
/// cleanly. A second one of the same kind ends it at once.
void catchInterrupts();

/// Whether one has arrived.
bool interrupted();

}  // namespace cairn::tool
