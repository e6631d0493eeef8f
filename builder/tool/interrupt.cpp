// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/interrupt.h"

#include <csignal>

namespace cairn::tool {
namespace {

volatile std::sig_atomic_t arrived = 0;  // the only state a signal handler may touch

void note(int) {
  arrived = 1;
}

}  // namespace

void catchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
  return arrived != 0;
}

}  // namespace cairn::tool
