// SPDX-License-Identifier: Zlib
#include "cairn/core/log.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "cairn/core/result.h"

namespace cairn {

namespace {

void toStandardError(const char* message, void* /*user*/) {
  std::fprintf(stderr, "cairn: %s\n", message);
}

struct Log {
  LogFunction function = toStandardError;
  void* user = nullptr;
};

Log& current() {
  static Log log;
  return log;
}

}  // namespace

void setLog(LogFunction function, void* user) {
  current() = function ? Log{function, user} : Log{};
}

void logMessage(const char* message) {
  current().function(message, current().user);
}

void dieUnchecked(const char* what, const char* message) {
  logMessage((std::string(what) + message).c_str());
  std::abort();
}

}  // namespace cairn
