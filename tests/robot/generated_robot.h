// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "builder_meshes.h"
#include "mesh_texts.h"

namespace cairn::test {

/// Two bodies of a CAD file that overlap: boxes with these corners, metres.
struct OverlappingBoxes {
  Vec3d lowerA{-0.05, -0.05, 0}, upperA{0.05, 0.05, 0.3}, lowerB{-0.03, -0.03, 0.2}, upperB{0.15, 0.03, 0.26};
};

/// With a triangle from an edge to a point inside: an edge of three triangles, which only a wrap mends.
inline builder::TriangleMesh withInnerWall(builder::TriangleMesh mesh, const Vec3d& inside) {
  const builder::Triangle first = mesh.triangles.front();
  mesh.triangles.push_back({first[0], first[1], static_cast<std::uint32_t>(mesh.vertices.size())});
  mesh.vertices.push_back(inside);
  return mesh;
}

inline builder::TriangleMesh boxBetween(const Vec3d& lower, const Vec3d& upper) {
  const Vec3d middle = (lower + upper) * 0.5;
  return moved(meshOf(cuboid(upper - lower, 1)), [&](const Vec3d& v) { return v + middle; });
}

/// A tube without lids.
inline builder::TriangleMesh openTube(double radius, double length, std::uint32_t sides) {
  builder::TriangleMesh mesh = cylinder(radius, length, sides);
  std::erase_if(mesh.triangles, [&](const builder::Triangle& t) { return t[2] >= 2 * sides; });
  return mesh;
}

/// A long lump without symmetry.
inline builder::TriangleMesh finger() {
  return moved(lumpyBall(3, 11), [](const Vec3d& v) { return Vec3d{20 * v.x + 5, 15 * v.y + 12, 60 * v.z + 55}; });
}

/// Six links with five joints: revolute, prismatic, fixed, continuous, and a revolute one that follows another.
inline std::string generatedRobotUrdf() {
  return R"(<?xml version="1.0"?>
<!-- kept: a comment before the robot -->
<robot name="six">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base">
    <inertial><origin xyz="0 0 0.05"/><mass value="4"/>
      <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.03"/></inertial>
    <collision><origin xyz="0 0 0.05"/><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
    <collision><origin xyz="0 0 0.15"/><geometry><cylinder radius="0.04" length="0.1"/></geometry></collision>
  </link>
  <link name="upper">
    <visual><geometry><mesh filename="package://six_description/meshes/cad.obj"/></geometry></visual>
    <collision name="cad">
      <origin xyz="0.01 -0.02 0.03" rpy="0.3 -0.2 1.1"/>
      <geometry><mesh filename="package://six_description/meshes/cad.obj"/></geometry>
    </collision>
  </link>
  <link name="slider">
    <collision><origin rpy="0 0 0.5"/>
      <geometry><mesh filename="../meshes/lump.ply" scale="0.05 0.08 0.04"/></geometry></collision>
    <collision><origin xyz="0.1 0 0"/><geometry><sphere radius="0.03"/></geometry></collision>
  </link>
  <link name="bracket">
    <collision><origin xyz="0 0 0.06"/><geometry><mesh filename="../meshes/tube.stl"/></geometry></collision>
  </link>
  <link name="left">
    <inertial><origin xyz="0 0.01 0.05" rpy="0.4 0.1 -0.3"/><mass value="0.2"/>
      <inertia ixx="0.0002" ixy="0.00001" ixz="0" iyy="0.0002" iyz="0" izz="0.0001"/></inertial>
    <collision><geometry><mesh filename="../meshes/finger.obj" scale="0.001 0.001 0.001"/></geometry></collision>
  </link>
  <link name="right">
    <collision><origin xyz="0 0 0.01"/>
      <geometry><mesh filename="../meshes/finger.obj" scale="0.001 -0.001 0.001"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.2" rpy="0 0.1 0"/><axis xyz="0 0 2"/>
    <limit lower="-2" upper="2.5" effort="10" velocity="1"/><dynamics damping="0.1" friction="0.02"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="upper"/><child link="slider"/><origin xyz="0.1 0 0.4"/><axis xyz="1 0 1"/>
    <limit lower="0.05" upper="0.3" effort="10" velocity="1"/>
  </joint>
  <joint name="stay" type="fixed">
    <parent link="slider"/><child link="bracket"/><origin xyz="0 0 0.12" rpy="0.2 0 0"/>
  </joint>
  <joint name="spin" type="continuous">
    <parent link="bracket"/><child link="left"/><origin xyz="0 0.04 0.14"/><axis xyz="1 0 0"/>
  </joint>
  <joint name="follow" type="revolute">
    <parent link="bracket"/><child link="right"/><origin xyz="0 -0.04 0.14"/><axis xyz="-1 0 0"/>
    <limit lower="-4" upper="4" effort="1" velocity="1"/><mimic joint="spin" multiplier="0.5" offset="0.1"/>
  </joint>
  <transmission name="kept"><type>a/b</type></transmission>
</robot>
)";
}

/// Writes the robot and its meshes as a ROS package below `folder`; returns the URDF.
inline std::filesystem::path writeGeneratedRobot(const std::filesystem::path& folder) {
  const OverlappingBoxes boxes;
  const auto package = folder / "six_description";
  std::filesystem::create_directories(package / "meshes");
  std::filesystem::create_directories(package / "urdf");
  writeText(package / "meshes/cad.obj",
            objText(withInnerWall(
                joined(boxBetween(boxes.lowerA, boxes.upperA), boxBetween(boxes.lowerB, boxes.upperB)), {0, 0, 0.1})));
  writeText(package / "meshes/lump.ply", plyText(lumpyBall(2, 7)));
  writeText(package / "meshes/tube.stl", stlText(openTube(0.04, 0.1, 16)));
  writeText(package / "meshes/finger.obj", objText(finger()));
  return writeText(package / "urdf/six.urdf", generatedRobotUrdf());
}

}  // namespace cairn::test
