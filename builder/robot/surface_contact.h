// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "cairn/builder/robot_model.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Triangles of a link as FCL's hierarchy of boxes; immutable, any thread may ask. FCL shares no code with the spheres
/// that it judges.
class LinkSurface {
 public:
  /// Surfaces in the link's frame.
  explicit LinkSurface(const std::vector<TriangleMesh>& meshes);
  ~LinkSurface();
  LinkSurface(LinkSurface&&) noexcept;

  /// True when it has no triangles.
  bool empty() const { return tree_ == nullptr; }
  /// Whether two surfaces have a point in common. `pose` leads from the other's frame into this one's.
  bool meets(const LinkSurface& other, const RigidPose& pose) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace cairn::builder
