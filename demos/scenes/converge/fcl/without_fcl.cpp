// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/converge/player.h"

namespace cairn::scenes {

Result<std::unique_ptr<Player>> makeFclPlayer(const Model&) {
  return Error{"this build has no FCL: install libfcl-dev and configure again, or leave out the shape fcl"};
}

}  // namespace cairn::scenes
