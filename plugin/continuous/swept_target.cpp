// SPDX-License-Identifier: Zlib
#include "continuous/swept_target.h"

#include "continuous/swept_convex.h"
#include "continuous/swept_field.h"
#include "continuous/swept_plane.h"
#include "continuous/swept_tree.h"
#include "continuous/swept_triangles.h"

namespace cairn::bullet {

std::unique_ptr<SweptTarget> makeSweptTarget(ColliderKind kind) {
  switch (kind) {
    case ColliderKind::tree:
      return std::make_unique<SweptTree>();
    case ColliderKind::plane:
      return std::make_unique<SweptPlane>();
    case ColliderKind::convex:
      return std::make_unique<SweptConvex>();
    case ColliderKind::field:
      return std::make_unique<SweptField>();
    case ColliderKind::terrain:
    case ColliderKind::triangles:
      break;
  }
  return std::make_unique<SweptTriangles>();
}

}  // namespace cairn::bullet
