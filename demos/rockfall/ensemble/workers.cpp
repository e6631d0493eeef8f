// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/workers.h"

#include <fmt/format.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace cairn::rockfall {
namespace {

constexpr int kFailed = 1;

struct Worker {
  pid_t process = 0;
  int pipe = -1;  // receives the process's error sentence
};

/// Ends this process with the one that started it, whose signals it may never hear of.
void endWith(pid_t starter) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (getppid() != starter) _exit(kFailed);
}

[[noreturn]] void workAndEnd(int pipe, std::uint32_t number, const std::function<Status(std::uint32_t)>& work) {
  const Status status = work(number);
  if (!status) {
    const std::string& sentence = status.error().message;
    // Sentences are shorter than the capacity of a pipe.
    if (write(pipe, sentence.data(), sentence.size()) < 0) _exit(kFailed);
  }
  _exit(status ? 0 : kFailed);
}

Result<Worker> start(std::uint32_t number, const std::function<Status(std::uint32_t)>& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return Error{fmt::format("cannot make a pipe: {}", std::strerror(errno))};
  const pid_t starter = getpid(), process = fork();
  if (process < 0) return Error{fmt::format("cannot start another process: {}", std::strerror(errno))};
  if (process == 0) {
    endWith(starter);
    close(ends[0]);
    workAndEnd(ends[1], number, work);
  }
  close(ends[1]);
  return Worker{process, ends[0]};
}

Status waitFor(const Worker& worker) {
  std::string sentence;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = read(worker.pipe, buffer.data(), buffer.size())) != 0;) {
    if (got > 0)
      sentence.append(buffer.data(), static_cast<std::size_t>(got));
    else if (errno != EINTR)
      break;
  }
  close(worker.pipe);
  int state = 0;
  while (waitpid(worker.process, &state, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return {};
  if (!sentence.empty()) return Error{sentence};
  return Error{WIFSIGNALED(state) ? fmt::format("a worker was killed by signal {}: run the same command again to go on",
                                                WTERMSIG(state))
                                  : std::string("a worker failed")};
}

}  // namespace

Status inProcesses(std::uint32_t count, const std::function<Status(std::uint32_t)>& work) {
  std::vector<Worker> workers;
  Status first;
  for (std::uint32_t i = 0; i < count && first; ++i) {
    auto worker = start(i, work);
    if (worker)
      workers.push_back(worker.value());
    else
      first = worker.error();
  }
  for (const Worker& worker : workers)
    if (const Status status = waitFor(worker); first && !status) first = status;
  return first;
}

}  // namespace cairn::rockfall
