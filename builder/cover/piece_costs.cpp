// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compiled once per instruction set by Highway; the best one the machine has is chosen when the program runs. Products
// and sums stay separate (no fused multiply-add) and in one order, so that every target gives the same bits.
#include "cover/piece_costs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cover/piece_costs.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::builder::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void pieceCosts(const Piece& piece, const double* HWY_RESTRICT x, const double* HWY_RESTRICT y,
                const double* HWY_RESTRICT z, const double* HWY_RESTRICT depth, std::size_t padded,
                double* HWY_RESTRICT costs) {
  const hn::CappedTag<double, 8> d;
  for (std::size_t i = 0; i < padded; i += hn::Lanes(d)) {
    const auto ballX = hn::LoadU(d, x + i), ballY = hn::LoadU(d, y + i), ballZ = hn::LoadU(d, z + i);
    const auto distanceSq = [&](const Vec3d& corner) {
      const auto dx = hn::Sub(ballX, hn::Set(d, corner.x)), dy = hn::Sub(ballY, hn::Set(d, corner.y)),
                 dz = hn::Sub(ballZ, hn::Set(d, corner.z));
      return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    };
    const auto mostSq =
        hn::Max(hn::Max(distanceSq(piece.corners[0]), distanceSq(piece.corners[1])), distanceSq(piece.corners[2]));
    hn::StoreU(hn::Sub(hn::Sqrt(mostSq), hn::LoadU(d, depth + i)), d, costs + i);
  }
}

}  // namespace cairn::builder::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::builder {

HWY_EXPORT(pieceCosts);

PieceCosts::PieceCosts(std::span<const Ball> balls) : size_(balls.size()) {
  constexpr std::size_t kWidest = 8;
  const std::size_t padded = (size_ + kWidest - 1) / kWidest * kWidest;
  for (std::vector<double>* list : {&x_, &y_, &z_, &depth_, &costs_}) list->resize(padded);
  for (std::size_t i = 0; i < size_; ++i) {
    x_[i] = balls[i].center.x;
    y_[i] = balls[i].center.y;
    z_[i] = balls[i].center.z;
    depth_[i] = balls[i].depth;
  }
}

std::span<const double> PieceCosts::of(const Piece& piece) {
  HWY_DYNAMIC_DISPATCH(pieceCosts)(piece, x_.data(), y_.data(), z_.data(), depth_.data(), x_.size(), costs_.data());
  return std::span(costs_).first(size_);
}

}  // namespace cairn::builder
#endif
