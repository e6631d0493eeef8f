// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/result.h"

namespace cairn::tool {

/// From now on the first SIGINT or SIGTERM is noted instead of ending the program, so that work in progress can stop
/// cleanly. Work that has not stopped half a second later is ended from outside with exit code 130, because nothing is
/// written before `beginWriting`. A second signal of the same kind ends the program at once.
void catchInterrupts();

/// Whether an interrupt has arrived.
bool interrupted();

/// Marks the end of the work: from here on outputs are written whatever arrives. Fails with `kCancelled` where an
/// interrupt came before. Further calls do nothing.
Status beginWriting();

}  // namespace cairn::tool
