// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/closed_scans.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "cairn/builder/repair.h"
#include "cairn/core/atomic_file.h"
#include "rockfall/validation/quarry_data.h"

namespace cairn::rockfall {
namespace {

namespace fs = std::filesystem;

Result<fs::path> makeTemporaryFolder() {
  std::error_code failure;
  const fs::path among = fs::temp_directory_path(failure);
  if (failure) return Error{"there is no folder for temporary files: " + failure.message()};
  std::string name = (among / "rockfall-scans-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    return Error{fmt::format("cannot make a folder in {}: {}", among.string(), std::strerror(errno))};
  return fs::path(name);
}

}  // namespace

Result<std::unique_ptr<ClosedScans>> ClosedScans::create(const fs::path& folder) {
  auto temporary = makeTemporaryFolder();
  if (!temporary) return temporary.error();
  auto scans = std::unique_ptr<ClosedScans>(new ClosedScans(std::move(temporary).value()));
  for (std::size_t scan = 0; scan < kScanNames.size(); ++scan) {
    const auto surface = builder::importSurface(folder / fmt::format("{}.stl", kScanNames[scan]));
    if (!surface) return surface.error();
    builder::RepairCounts counts;
    const auto solid = builder::repair(surface.value(), &counts);
    if (!solid) return solid.error();
    if (counts.any()) scans->repairs_.push_back(fmt::format("{}: {}", kScanNames[scan], counts.text()));
    const std::string text = builder::plyBytes(solid.value());
    if (const Status written = writeFileAtomically(scans->file(scan), text); !written) return written.error();
  }
  return scans;
}

ClosedScans::~ClosedScans() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path ClosedScans::file(std::size_t scan) const {
  return folder_ / fmt::format("{}.ply", kScanNames[scan]);
}

}  // namespace cairn::rockfall
