// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "cairn/builder/progress.h"
#include "cairn/core/result.h"
#include "common/errors.h"

namespace cairn::python {

/// Work of the builder on a thread of its own, and what its caller hears of it.
class Job {
 public:
  /// For the work: notes its progress; false once it is cancelled.
  bool report(std::string_view stage, double fraction);
  /// For the work: it is over, by an exception or not.
  void finish(std::exception_ptr failure);
  /// For the caller, with the interpreter's lock: waits until the work is over, and rethrows its exception. Meanwhile
  /// the lock is free, `progress` (a callable, or None) is called on this thread, and signals are seen. An exception of
  /// the callable or of a signal's handler cancels the work and goes on to the caller, within a second: work that has
  /// not ended by then goes on unheard, and what it returns is dropped.
  void wait(const pybind11::object& progress);

 private:
  bool waitFor(std::chrono::milliseconds time);
  void tell(const pybind11::object& progress);
  [[noreturn]] void rethrow() const;

  std::mutex mutex_;  // protects everything below
  std::condition_variable ended_;
  std::string stage_;
  double fraction_ = 0;
  bool hasNews_ = false, isOver_ = false, isCancelled_ = false;
  std::exception_ptr failure_;
};

/// Starts `run` on a thread, with at most so many threads for its parallel parts; 0: one per core. `run` throws nothing
/// and owns all it needs, because it may outlive its caller.
void startThread(unsigned threads, std::function<void()> run);

/// To be called once, before the first thread: a fork of the process has none of its threads.
void prepareThreads();

/// Waits for all threads that were started and are still at work; for the end of the interpreter.
void joinThreads();

/// Runs `work(progress)`, which returns a Result and owns all it needs, and returns its value. Raises the Result's
/// sentence as cairn.Error. See `Job::wait`.
template <class Work>
auto valueOfWork(Work work, unsigned threads, const pybind11::object& progress) {
  using Outcome = std::invoke_result_t<Work&, const builder::ProgressCallback&>;
  const auto job = std::make_shared<Job>();
  const auto outcome = std::make_shared<std::optional<Outcome>>();
  startThread(threads, [job, outcome, work = std::move(work)]() mutable {
    std::exception_ptr failure;
    try {
      outcome->emplace(work([&](std::string_view stage, double fraction) { return job->report(stage, fraction); }));
    } catch (...) {
      failure = std::current_exception();
    }
    job->finish(failure);
  });
  job->wait(progress);
  return valueOf(*std::move(*outcome));
}

}  // namespace cairn::python
