// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/program_hash.h"

#include <cstddef>
#include <span>

#include "cairn/core/atomic_file.h"
#include "rockfall/case/content_hash.h"

namespace cairn::rockfall {

const std::string& programHash() {
  static const std::string kHash = [] {
    const auto program = readFile("/proc/self/exe");
    if (!program) return std::string();
    ContentHash hash;
    hash.add(std::span<const std::byte>(program.value()));
    return hash.hex();
  }();
  return kHash;
}

}  // namespace cairn::rockfall
