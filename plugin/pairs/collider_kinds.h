// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "colliders/collider.h"
#include "continuous/swept_target.h"

namespace cairn::bullet {

/// What a tree can meet, in the order in which shapes are asked; the last takes all that show their triangles.
enum class ColliderKind : std::uint8_t { tree, plane, convex, field, terrain, triangles };
inline constexpr std::size_t kColliderKinds = std::size_t{1} + static_cast<std::size_t>(ColliderKind::triangles);

/// The kind of collider for a shape. Empty for compounds, soft bodies and GImpact compounds: these are not convex, have
/// no distance field and show no triangles.
std::optional<ColliderKind> kindOf(const btCollisionShape& shape);

/// Makes a collider of this kind; it must be placed before use.
std::unique_ptr<Collider> makeCollider(ColliderKind kind);

/// Makes what fast bodies meet in its place.
std::unique_ptr<SweptTarget> makeSweptTarget(ColliderKind kind);

}  // namespace cairn::bullet
