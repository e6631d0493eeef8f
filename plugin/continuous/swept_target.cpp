// SPDX-License-Identifier: Zlib
#include "continuous/swept_target.h"

#include "continuous/swept_convex.h"
#include "continuous/swept_field.h"
#include "continuous/swept_plane.h"
#include "continuous/swept_tree.h"
#include "continuous/swept_triangles.h"

namespace cairn::bullet {

std::unique_ptr<SweptTarget> makeSweptTarget(CounterpartKind kind) {
  switch (kind) {
    case CounterpartKind::tree:
      return std::make_unique<SweptTree>();
    case CounterpartKind::plane:
      return std::make_unique<SweptPlane>();
    case CounterpartKind::convex:
      return std::make_unique<SweptConvex>();
    case CounterpartKind::field:
      return std::make_unique<SweptField>();
    case CounterpartKind::terrain:
    case CounterpartKind::triangles:
      break;
  }
  return std::make_unique<SweptTriangles>();
}

}  // namespace cairn::bullet
