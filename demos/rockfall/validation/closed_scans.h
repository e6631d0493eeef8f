// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::rockfall {

/// The scanned blocks with their holes closed, as files of a folder of their own, which ends with this: scans are open
/// where the scanner did not see, and only a solid has a certified tree.
class ClosedScans {
 public:
  /// Fails as `builder::importSurface` and `builder::repair` do, and for what cannot be written.
  static Result<std::unique_ptr<ClosedScans>> create(const std::filesystem::path& folder);
  ~ClosedScans();
  ClosedScans(const ClosedScans&) = delete;
  ClosedScans& operator=(const ClosedScans&) = delete;

  /// Of the scan with that number in `kScanNames`.
  std::filesystem::path file(std::size_t scan) const;
  /// What was closed: a sentence for each scan of which something was.
  const std::vector<std::string>& repairs() const { return repairs_; }

 private:
  explicit ClosedScans(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::vector<std::string> repairs_;
};

}  // namespace cairn::rockfall
