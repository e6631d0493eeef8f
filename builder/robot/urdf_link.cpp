// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string_view>

#include "robot/urdf_element.h"

namespace cairn::builder {
namespace {

void readMesh(const pugi::xml_node& mesh, UrdfElements& elements, CollisionShape& shape) {
  shape.kind = CollisionKind::mesh;
  shape.mesh = elements.text(mesh, "filename");
  shape.size = elements.vector(mesh, "scale", {1, 1, 1});
  for (int axis = 0; axis < 3; ++axis)
    if (shape.size[axis] == 0) elements.fail(mesh, "a scale of 0 flattens the mesh; correct it");
}

void readGeometry(const pugi::xml_node& geometry, UrdfElements& elements, CollisionShape& shape) {
  const pugi::xml_node node = geometry.find_child([](const auto& n) { return n.type() == pugi::node_element; });
  const std::string_view kind = node.name();
  if (kind == "mesh") return readMesh(node, elements, shape);
  if (kind == "box") {
    shape.kind = CollisionKind::box;
    shape.size = elements.vector(node, "size");
    if (!elements.failure() && !(shape.size.x > 0 && shape.size.y > 0 && shape.size.z > 0))
      elements.fail(node, "size of <box> is not above 0; correct it");
  } else if (kind == "cylinder") {
    shape.kind = CollisionKind::cylinder;
    shape.size = {elements.length(node, "radius"), elements.length(node, "length"), 0};
  } else if (kind == "sphere") {
    shape.kind = CollisionKind::sphere;
    shape.size = {elements.length(node, "radius"), 0, 0};
  } else if (kind.empty()) {
    elements.fail(geometry ? geometry : geometry.parent(), "a <collision> has no geometry; give it one");
  } else {
    elements.fail(node, fmt::format("<{:.40}> is not a shape of URDF; use mesh, box, cylinder or sphere", kind));
  }
}

CollisionShape readCollision(const pugi::xml_node& node, UrdfElements& elements) {
  CollisionShape shape;
  shape.origin = elements.origin(node);
  const pugi::xml_node geometry = node.child("geometry");
  if (!geometry)
    elements.fail(node, "a <collision> has no geometry; give it one");
  else
    readGeometry(geometry, elements, shape);
  return shape;
}

LinkInertia readInertia(const pugi::xml_node& node, UrdfElements& elements) {
  LinkInertia result;
  result.origin = elements.origin(node);
  const pugi::xml_node mass = node.child("mass"), inertia = node.child("inertia");
  if (!mass || !inertia) {
    elements.fail(node, "an <inertial> needs <mass> and <inertia>; add them");
    return result;
  }
  result.mass = elements.number(mass, "value");
  const double ixx = elements.number(inertia, "ixx"), ixy = elements.number(inertia, "ixy"),
               ixz = elements.number(inertia, "ixz"), iyy = elements.number(inertia, "iyy"),
               iyz = elements.number(inertia, "iyz"), izz = elements.number(inertia, "izz");
  result.inertia.rows = {Vec3d{ixx, ixy, ixz}, Vec3d{ixy, iyy, iyz}, Vec3d{ixz, iyz, izz}};
  return result;
}

}  // namespace

Mat3d rotationAbout(const Vec3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  const auto& [x, y, z] = axis;
  return {{Vec3d{t * x * x + c, t * x * y - s * z, t * x * z + s * y},
           Vec3d{t * x * y + s * z, t * y * y + c, t * y * z - s * x},
           Vec3d{t * x * z - s * y, t * y * z + s * x, t * z * z + c}}};
}

Mat3d rotationOf(const Vec3d& rpy) {
  return rotationAbout({0, 0, 1}, rpy.z) * rotationAbout({0, 1, 0}, rpy.y) * rotationAbout({1, 0, 0}, rpy.x);
}

RigidPose UrdfElements::origin(const pugi::xml_node& node) {
  const pugi::xml_node origin = node.child("origin");
  if (!origin) return {};
  return {rotationOf(vector(origin, "rpy", {})), vector(origin, "xyz", {})};
}

RobotLink readLink(const pugi::xml_node& node, UrdfElements& elements) {
  RobotLink link;
  link.name = elements.text(node, "name");
  for (const pugi::xml_node& collision : node.children("collision"))
    link.collisions.push_back(readCollision(collision, elements));
  if (const pugi::xml_node inertial = node.child("inertial")) link.inertia = readInertia(inertial, elements);
  return link;
}

}  // namespace cairn::builder
