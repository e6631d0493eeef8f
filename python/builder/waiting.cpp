// SPDX-License-Identifier: GPL-3.0-or-later
#include "builder/waiting.h"

#include <pthread.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

namespace py = pybind11;

namespace cairn::python {
namespace {

using std::chrono::milliseconds;

/// How often signals are looked for and progress is told, and how long cancelled work may take to end by itself: both
/// together stay below the second in which Ctrl-C has to act.
constexpr milliseconds kBetweenLooks(50), kGrace(300);

std::atomic<int> running = 0;

}  // namespace

bool Job::report(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  fraction_ = fraction;
  hasNews_ = true;
  return !isCancelled_;
}

void Job::finish(std::exception_ptr failure) {
  const std::lock_guard lock(mutex_);
  failure_ = std::move(failure);
  isOver_ = true;
  ended_.notify_all();
}

bool Job::waitFor(milliseconds time) {
  const py::gil_scoped_release released;
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, time, [&] { return isOver_; });
}

void Job::tell(const py::object& progress) {
  std::string stage;
  double fraction = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(hasNews_, false)) return;
    stage = stage_;
    fraction = fraction_;
  }
  if (!progress.is_none()) progress(stage, fraction);
}

void Job::rethrow() const try { std::rethrow_exception(failure_); } catch (const std::bad_alloc&) {
  throw;  // becomes MemoryError
} catch (const std::exception& e) {
  refuse(std::string("stopped by an unexpected failure (") + e.what() + ")");
}

void Job::wait(const py::object& progress) try {
  for (bool isOver = false; !isOver;) {
    isOver = waitFor(kBetweenLooks);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    tell(progress);
  }
  if (failure_) rethrow();
} catch (...) {
  {
    const std::lock_guard lock(mutex_);
    isCancelled_ = true;
  }
  waitFor(kGrace);
  throw;
}

void startThread(unsigned threads, std::function<void()> run) {
  ++running;
  try {
    std::thread([threads, run = std::move(run)]() mutable {
      {
        tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
        arena.execute(run);
        run = nullptr;  // all it owns goes before it stops counting
      }
      --running;
    }).detach();
  } catch (...) {
    --running;
    throw;
  }
}

void prepareThreads() {
  pthread_atfork(nullptr, nullptr, [] { running = 0; });
}

void joinThreads() {
  const py::gil_scoped_release released;
  while (running > 0) std::this_thread::sleep_for(kBetweenLooks);
}

}  // namespace cairn::python
