// SPDX-License-Identifier: Zlib
#pragma once

namespace cairn::refit {

// All numbers that decide how a tree follows its mesh. None decides whether its cover and errors hold, but for the
// bounds on rounding at the end. See `TreeRefit`.

/// In radii of a leaf's ball: the side of a part that is not cut again. Without an end, cutting would go on for ever
/// where only the borders of balls meet.
inline constexpr double kSmallest = 0.125;
/// Halvings of a triangle at most. Places are then multiples of 2^-20, so that products of two have no rounding.
inline constexpr int kMaxHalvings = 20;

/// Newton steps towards the nearest rotation. They double the correct digits; scaled, twelve suffice from any matrix
/// that passes `kMinVolume`.
inline constexpr int kIterations = 12;
/// Of a matrix's determinant, in cubes of its norm: below it, which rotation is nearest is left to rounding.
inline constexpr double kMinVolume = 1e-9;

/// Shifts of a ball's centre at most. Twice as many make the errors of `moving_bench` smaller by 2 % at most.
inline constexpr int kMaxShifts = 4;
/// In errors of the ball: a shorter shift is not worth another search for the nearest triangle.
inline constexpr double kWorthAShift = 0.05;

/// Of the largest coordinate: half an ulp of a float, for places that are kept as such, room for all roundings of
/// doubles besides, and the room that `certify` needs to prove a cover.
inline constexpr double kRounding = 0x1p-23;
/// Of a normal cone's cosine: some roundings of a unit vector's coordinates and of a product.
inline constexpr float kConeRounding = 1e-6F;
/// What squares of distances to boxes lose to rounding in floats: some units of 2^-24.
inline constexpr float kBoxRounding = 1 - 0x1p-20F;
/// Of the largest coordinate: what a height above a plane loses to a float's rounding of four terms, of the plane's own
/// four numbers and of products. Some ten units of 2^-24, and room.
inline constexpr float kFaceRounding = 0x1p-19F;
/// Cosine of the angle to a normal above which a point is not said to lie behind it.
inline constexpr double kDoubt = 1e-9;

}  // namespace cairn::refit
