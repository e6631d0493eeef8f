// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/core/export.h"

#include "cairn/core/result.h"

namespace cairn {

/// Writes a file completely or not at all: to a temporary name beside `path`, flushed to disk, then renamed over it. On
/// failure `path` is as it was and the temporary file is gone (only a process that is killed outright leaves it). A
/// symbolic link is followed; what is no regular file, a device or a pipe, is written to directly.
CAIRN_CORE_EXPORT
Status writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
/// The same for text.
CAIRN_CORE_EXPORT
Status writeFileAtomically(const std::filesystem::path& path, std::string_view text);

/// For writers that insist on a file name of their own: `write` gets a temporary path beside `path` with the same
/// extension, which is renamed over `path` when it returns success and removed when it does not. Devices and pipes are
/// refused.
CAIRN_CORE_EXPORT
Status writeFileAtomically(const std::filesystem::path& path,
                           const std::function<Status(const std::filesystem::path& temporary)>& write);

/// The path a symbolic link leads to, whether or not there is a file yet, through links to links; any other path as it
/// is: where `writeFileAtomically` writes.
CAIRN_CORE_EXPORT
std::filesystem::path behindLinks(std::filesystem::path path);

/// Whether a file could be written at `path`, without touching it: it is named, its folder exists and may be written,
/// and it is no folder itself; or it is a device or a pipe that may be written. To be asked before the work whose
/// result it is to hold.
CAIRN_CORE_EXPORT
Status checkWritable(const std::filesystem::path& path);

/// Whether every output could be written and is neither an input nor another output, whatever names they go by. To be
/// asked before any work. Empty paths are passed over.
CAIRN_CORE_EXPORT
Status checkOutputs(const std::vector<std::filesystem::path>& inputs,
                    const std::vector<std::filesystem::path>& outputs);

/// Whole content of a file, or an error that names it.
CAIRN_CORE_EXPORT
Result<std::vector<std::byte>> readFile(const std::filesystem::path& path);

}  // namespace cairn
