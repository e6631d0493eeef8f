// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::builder {

/// A rigid motion: `pose(p)` is `rotation * p + translation`. Metres.
struct RigidPose {
  Mat3d rotation;     ///< proper: determinant 1
  Vec3d translation;  ///< metres

  /// The point in the frame the pose leads to.
  Vec3d operator()(const Vec3d& p) const { return rotation * p + translation; }
  /// First `b`, then `a`.
  friend RigidPose operator*(const RigidPose& a, const RigidPose& b) {
    return {a.rotation * b.rotation, a(b.translation)};
  }
  /// The motion back.
  RigidPose inverse() const { return {transpose(rotation), -(transpose(rotation) * translation)}; }
};

/// The geometry of a URDF's `<collision>`.
enum class CollisionKind : std::uint8_t { mesh, box, cylinder, sphere };

/// One `<collision>` of a link.
struct CollisionShape {
  CollisionKind kind = CollisionKind::mesh;  ///< its geometry
  RigidPose origin;                          ///< from the shape's frame to the link's
  std::string mesh;                          ///< the file as the URDF names it; of meshes only
  /// Scale of a mesh (no factor is 0, some may be negative); edges of a box; radius and length of a cylinder, whose
  /// axis is z; radius of a sphere. Metres.
  Vec3d size{1, 1, 1};
};

/// Mass and inertia of a link.
struct LinkInertia {
  RigidPose origin;  ///< from the frame of the inertia to the link's
  double mass = 0;   ///< kilograms
  Mat3d inertia;     ///< about the centre of mass, kg m^2
};

/// A link, with its shapes in the order of the file.
struct RobotLink {
  std::string name;                        ///< as the URDF names it
  std::vector<CollisionShape> collisions;  ///< in the order of the file
  std::optional<LinkInertia> inertia;      ///< nothing where the URDF has none
  std::optional<std::uint32_t> joint;      ///< the joint it hangs on; nothing: the root
};

/// The types of URDF joints.
enum class JointType : std::uint8_t { fixed, revolute, continuous, prismatic, planar, floating };

/// A joint whose position follows another's: `multiplier * position + offset`.
struct JointMimic {
  std::uint32_t joint = 0;  ///< the index of the one followed
  double multiplier = 1;    ///< of the followed position
  double offset = 0;        ///< radians or metres, added to it
};

/// A joint. Positions are radians or metres.
struct RobotJoint {
  std::string name;                     ///< as the URDF names it
  JointType type = JointType::fixed;    ///< how it moves
  std::uint32_t parent = 0, child = 0;  ///< links
  RigidPose origin;                     ///< from the child's frame at position 0 to the parent's
  Vec3d axis{1, 0, 0};                  ///< unit vector, child's frame
  double lower = 0, upper = 0;          ///< range; of `continuous` joints one turn
  double damping = 0, friction = 0;     ///< as the URDF gives them
  std::optional<JointMimic> mimic;      ///< the joint it follows, if it follows one

  /// True when the joint has a position of its own: not fixed, planar or floating, and follows no other.
  bool isActive() const;
};

/// A robot as its URDF describes it: a tree of links.
struct RobotModel {
  std::string name;                         ///< as the URDF names it
  std::string file;                         ///< name of the file without folder, for messages
  std::vector<RobotLink> links;             ///< in the order of the file
  std::vector<RobotJoint> joints;           ///< in the order of the file
  std::uint32_t root = 0;                   ///< a link
  std::vector<std::uint32_t> parentsFirst;  ///< all links, each after its parent
  std::string text;                         ///< the document

  /// Position 0 of a joint, or the end of its range that is nearest to 0.
  double defaultPosition(std::uint32_t joint) const;
  /// Poses of all links in the root's frame. `positions` holds one for each joint; those of inactive joints are ignored
  /// (planar and floating ones stay at their origin). Linear.
  std::vector<RigidPose> poses(const std::vector<double>& positions) const;
};

/// Reads a URDF (the format of ROS: http://wiki.ros.org/urdf/XML). Fails, with one sentence that names the place, for
/// XML that is not well formed or has a document type, numbers that are not finite, unknown shapes and joints, and for
/// links that do not form one tree.
///
///     RobotModel arm = readUrdf("arm.urdf").value();
Result<RobotModel> readUrdf(const std::filesystem::path& path);

/// Longest URDF that is read, in bytes. Those of large humanoids have about 200,000.
inline constexpr std::size_t kMaxUrdfBytes = std::size_t{64} << 20;

}  // namespace cairn::builder
