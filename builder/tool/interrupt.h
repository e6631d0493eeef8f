// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/result.h"

namespace cairn::tool {

/// From now on the first SIGINT or SIGTERM is noted instead of ending the program, so that work in progress can stop
/// cleanly. What has not stopped half a second later, in a library that asks nobody, is ended from outside with 130:
/// nothing is written before `beginWriting`. A second signal of the same kind ends the program at once.
void catchInterrupts();

/// Whether one has arrived.
bool interrupted();

/// The work is done and its outputs are written from here to the end, whatever arrives. The error `kCancelled` where an
/// interrupt came before. Again: nothing.
Status beginWriting();

}  // namespace cairn::tool
