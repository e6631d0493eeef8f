// SPDX-License-Identifier: Zlib
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace cairn::test {

/// Starts a program, sends it `signal` after `delay`, and returns how it ended.
inline int exitCodeAfterSignal(const std::string& program, const std::vector<std::string>& arguments, int signal,
                               std::chrono::milliseconds delay) {
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> argv;
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), program);
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDERR_FILENO);
    dup2(null, STDOUT_FILENO);
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  std::this_thread::sleep_for(delay);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, WNOHANG), 0) << "it ended before it could be interrupted";
  kill(child, signal);
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace cairn::test
