// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "cairn/builder/build.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::fuzz {

/// Hands out an input's bytes one by one, zeros after its end: every input means something.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t next() { return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0}; }
  /// 0 to `count` - 1. Precondition: 0 < `count` < 65536.
  std::uint32_t below(std::uint32_t count) {
    const std::uint32_t high = next();
    return (high << 8 | next()) % count;
  }
  bool done() const { return at_ >= bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// One of a few solids, some hundred triangles at most, with what damage the bytes ask for: triangles left out, twice
/// there or turned, vertices joined, split or moved, the whole flattened, scaled, moved far, joined with itself, a
/// number made not a number.
builder::TriangleMesh meshFrom(Bytes& bytes);

/// Any method and treatment, small enough for milliseconds; now and then a number out of range.
builder::BuildOptions optionsFrom(Bytes& bytes);

}  // namespace cairn::fuzz
