// SPDX-License-Identifier: Zlib
#include "platform/files.h"

#include <cerrno>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#else
#include <unistd.h>
#endif

namespace cairn::platform {

#if defined(_WIN32)

// Names are wide there, and the run-time library knows no exclusive mode of `fopen`.
std::FILE* openFile(const std::filesystem::path& path, Open how) {
  if (how != Open::writeNew) return _wfopen(path.c_str(), how == Open::read ? L"rb" : L"wb");
  const int file = _wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY, _S_IREAD | _S_IWRITE);
  return file < 0 ? nullptr : _fdopen(file, "wb");
}

bool flushToDisk(std::FILE* file) {
  return std::fflush(file) == 0 && (_commit(_fileno(file)) == 0 || errno == EBADF || errno == EINVAL);
}

bool mayWrite(const std::filesystem::path& path) {
  constexpr int kToWrite = 2;  // the run-time library has no name for it
  return _waccess(path.c_str(), kToWrite) == 0;
}

#else

std::FILE* openFile(const std::filesystem::path& path, Open how) {
  return std::fopen(path.c_str(), how == Open::read ? "rb" : how == Open::write ? "wb" : "wbx");
}

bool flushToDisk(std::FILE* file) {
  return std::fflush(file) == 0 && (fsync(fileno(file)) == 0 || errno == EINVAL || errno == ENOTSUP);
}

bool mayWrite(const std::filesystem::path& path) {
  return access(path.c_str(), W_OK) == 0;
}

#endif

}  // namespace cairn::platform
