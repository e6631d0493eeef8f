// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "cairn/builder/progress.h"
#include "tool/command.h"

namespace cairn::tool {
namespace {

// Time that a cancelled run gets to stop by itself, so that it ends within a second.
constexpr std::chrono::milliseconds kGrace(500);

volatile std::sig_atomic_t arrived = 0;  // a signal handler may touch only this and the pipe
std::array<int, 2> wake = {-1, -1};
std::mutex mutex;  // protects `isWriting`
bool isWriting = false;

void note(int) {
  const int before = errno;
  arrived = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake[1], "", 1);
  errno = before;
}

void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

void endUnstoppedWork() {
  char byte = 0;
  while (::read(wake[0], &byte, 1) < 0 && errno == EINTR) {
  }
  std::this_thread::sleep_for(kGrace);
  const std::lock_guard lock(mutex);
  if (isWriting) return;
  if (isatty(STDERR_FILENO) != 0) say("\r\033[K");
  say("cairn: cancelled\n");
  _exit(kCancelledByUser);
}

}  // namespace

void catchInterrupts() {
  if (pipe2(wake.data(), O_CLOEXEC) == 0) std::thread(endUnstoppedWork).detach();
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

Status beginWriting() {
  const std::lock_guard lock(mutex);
  if (!isWriting && interrupted()) return Error{std::string(builder::kCancelled)};
  isWriting = true;
  return {};
}

}  // namespace cairn::tool
