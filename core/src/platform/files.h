// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdio>
#include <filesystem>

namespace cairn::platform {

/// What standard C++ cannot say about files: the one place of this library that differs between systems.

enum class Open {
  read,
  write,     ///< Emptied if it exists.
  writeNew,  ///< Refused if it exists.
};

/// Opens a file for bytes, or returns null and leaves the reason in `errno`.
std::FILE* openFile(const std::filesystem::path& path, Open how);

/// Waits until all that was written is on the disk; false on failure, with the reason in `errno`. Devices and pipes
/// cannot be waited for; that is no failure.
bool flushToDisk(std::FILE* file);

/// Whether this process may write the file or into the folder. The answer may be out of date at once.
bool mayWrite(const std::filesystem::path& path);

}  // namespace cairn::platform
