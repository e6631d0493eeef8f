// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Numbers as a browser's typed arrays hold them: 32 bits each, little-endian, on any machine.
class PackedArray {
 public:
  void add(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes_.push_back(static_cast<unsigned char>(value >> shift));
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(const Vec3& v) {
    for (const float value : {v.x, v.y, v.z}) add(value);
  }

  /// The numbers in base64 (RFC 4648, padded).
  std::string base64() const;

 private:
  std::vector<unsigned char> bytes_;
};

}  // namespace cairn::builder
