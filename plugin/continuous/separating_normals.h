// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The directions along which two regions may be apart, at most `kMax`; further ones are dropped. Filled by
/// `SweptTarget` and `TreeParts`, tried by `Sweep`.
class SeparatingNormals {
 public:
  static constexpr std::size_t kMax = 16;

  void clear() { count_ = 0; }
  /// `normal`: unit; zero is ignored. `isFace`: it belongs to a face of either region, not to a line between them.
  void add(const Vec3& normal, bool isFace) {
    if (count_ == kMax || lengthSq(normal) == 0) return;
    normals_[count_] = normal;
    isFace_[count_++] = isFace;
  }
  /// Rotates all normals.
  void turn(const Mat3& rotation) {
    for (Vec3& normal : std::span(normals_).first(count_)) normal = rotation * normal;
  }
  std::span<const Vec3> all() const { return std::span(normals_).first(count_); }
  bool isFace(std::size_t i) const { return isFace_[i]; }

 private:
  std::array<Vec3, kMax> normals_;
  std::array<bool, kMax> isFace_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
