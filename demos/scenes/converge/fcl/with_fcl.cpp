// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include <utility>

#include "scenes/converge/player.h"
#include "scenes/figures/cpu_clock.h"
#include "scenes/truth/placed_body.h"

namespace cairn::scenes {
namespace {

using Geometry = fcl::BVHModel<fcl::OBBRSSd>;

/// The number of contacts that btPersistentManifold keeps for a pair.
constexpr std::size_t kMaxContacts = 4;

fcl::Transform3d toFcl(const Placement& placement) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) transform(row, column) = placement.rotation(row, column);
    transform(row, 3) = placement.translation[row];
  }
  return transform;
}

class FclPlayer final : public Player {
 public:
  explicit FclPlayer(const Model& model) : model_(model) {
    std::vector<fcl::Vector3d> vertices;
    for (const Vec3d& v : model.vertices) vertices.emplace_back(v.x, v.y, v.z);
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : model.triangles) triangles.emplace_back(a, b, c);
    geometry_.beginModel();
    geometry_.addSubModel(vertices, triangles);
    geometry_.endModel();
  }

  Status begin() override { return {}; }  // nothing is kept from frame to frame

  StepRecord show(std::span<const BodyMotion> motions) override {
    const double started = threadCpuMicroseconds();
    place(motions);
    StepRecord record;
    const double start = threadCpuMicroseconds();
    for (auto& [first, second, result] : pairs_)
      fcl::collide(&geometry_, transforms_[first], &geometry_, transforms_[second], request_, result);
    const double end = threadCpuMicroseconds();
    record.narrowPhaseCpuUs = end - start;
    record.stepCpuUs = end - started;
    for (const Pair& pair : pairs_) {
      record.contacts += static_cast<std::uint32_t>(pair.result.numContacts());
      record.manifolds += pair.result.isCollision();
    }
    return record;
  }

  std::vector<ReportedContact> contacts() const override {
    std::vector<ReportedContact> contacts;
    for (const auto& [first, second, result] : pairs_)
      for (std::size_t c = 0; c < result.numContacts(); ++c) {
        const fcl::Vector3d& p = result.getContact(c).pos;
        const Vec3d point{p.x(), p.y(), p.z()};
        contacts.push_back({static_cast<int>(first), static_cast<int>(second), point, point});
      }
    return contacts;
  }

 private:
  struct Pair {
    std::size_t first, second;
    fcl::CollisionResultd result;
  };

  void place(std::span<const BodyMotion> motions) {
    transforms_.clear();
    pairs_.clear();
    std::vector<Box> boxes;
    for (const BodyMotion& motion : motions) {
      const PlacedBody body = placeBody(motion.pose, model_);
      transforms_.push_back(toFcl(body.worldFromBody));
      boxes.push_back(body.box);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
        if (boxes[i].overlaps(boxes[j])) pairs_.push_back({i, j, {}});
  }

  const Model& model_;
  Geometry geometry_;
  fcl::CollisionRequestd request_{kMaxContacts, true};
  std::vector<fcl::Transform3d> transforms_;
  std::vector<Pair> pairs_;
};

}  // namespace

Result<std::unique_ptr<Player>> makeFclPlayer(const Model& model) {
  return Result<std::unique_ptr<Player>>(std::make_unique<FclPlayer>(model));
}

}  // namespace cairn::scenes
