// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cairn/builder/robot.h"
#include "cairn/builder/robot_view.h"
#include "cairn/core/outward_rounding.h"
#include "robot/joint_types.h"
#include "robot/mesh_paths.h"
#include "robot/mirror_match.h"
#include "robot/primitive_meshes.h"
#include "robot/robot_solid.h"

namespace cairn::builder {
namespace {

/// The robot with the spheres that its URDF has, and nothing fitted. Meshes are no parts of it.
FittedRobot givenSpheres(const RobotModel& model) {
  FittedRobot given;
  for (const RobotLink& link : model.links) {
    std::vector<RobotPart>& parts = given.links.emplace_back();
    for (std::uint32_t c = 0; c < link.collisions.size(); ++c) {
      const CollisionShape& shape = link.collisions[c];
      if (shape.kind == CollisionKind::mesh) continue;
      RobotPart& part = parts.emplace_back();
      part.collision = c;
      if (shape.kind == CollisionKind::sphere) part.balls = {Ball{shape.origin.translation, shape.size.x, 0}};
    }
  }
  return given;
}

Result<FittedRobot> spheresOf(const RobotModel& model, const std::filesystem::path& urdf,
                              const RobotViewOptions& options, const ProgressCallback& progress) {
  if (!options.spheres) return givenSpheres(model);
  RobotOptions wanted;
  wanted.budget.perLink = options.spheres;
  wanted.primitives = true;
  wanted.packages = options.packages;
  wanted.seed = options.seed;
  return fitRobot(model, urdf, wanted, progress);
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

/// The shape in its own frame, as the file has it: open or not.
Result<TriangleMesh> surfaceOf(const CollisionShape& shape, const std::filesystem::path& urdf,
                               const PackagePaths& packages) {
  if (shape.kind != CollisionKind::mesh) return keptSurface(shape);
  const Result<std::filesystem::path> path = resolveMesh(shape.mesh, urdf, packages);
  if (!path) return path.error();
  Result<TriangleMesh> mesh =
      readScaledSurface(path.value(), {std::abs(shape.size.x), std::abs(shape.size.y), std::abs(shape.size.z)});
  if (!mesh) return mesh;
  return mirrored(std::move(mesh).value(), signsOf(shape.size));
}

/// All shapes of a link but its spheres, in its frame.
Result<TriangleMesh> meshOf(const RobotModel& model, const RobotLink& link, const std::filesystem::path& urdf,
                            const PackagePaths& packages) {
  TriangleMesh mesh;
  for (const CollisionShape& shape : link.collisions) {
    if (shape.kind == CollisionKind::sphere) continue;
    Result<TriangleMesh> surface = surfaceOf(shape, urdf, packages);
    if (!surface) return Error{fmt::format("{}: link '{}': {}", model.file, link.name, surface.error().message)};
    for (Vec3d& v : surface.value().vertices) v = shape.origin(v);
    append(mesh, surface.value());
  }
  return mesh;
}

/// The middle and size of what has no mesh.
void frameSpheres(const std::vector<RobotPart>& parts, ViewLink& link) {
  TriangleMesh corners;
  for (const RobotPart& part : parts)
    for (const Ball& ball : part.balls)
      for (const double sign : {-1.0, 1.0})
        corners.vertices.push_back(ball.center + Vec3d{1, 1, 1} * (sign * ball.radius));
  if (corners.vertices.empty()) return;
  const Bounds bounds = boundsOf(corners);
  link.origin = bounds.center();
  link.diagonal = bounds.diagonal();
}

void addSpheres(const std::vector<RobotPart>& parts, ViewLink& link) {
  for (const RobotPart& part : parts)
    for (std::size_t i = 0; i < part.balls.size(); ++i)
      link.spheres.push_back(
          {.center = Vec3(part.balls[i].center - link.origin),
           .radius = static_cast<float>(part.balls[i].radius),
           .error = part.errors.empty() ? std::numeric_limits<float>::quiet_NaN() : roundUp(part.errors[i]),
           .parent = static_cast<std::uint32_t>(link.spheres.size())});
}

std::string nameOf(JointType type) {
  return std::string(std::ranges::find(kJointTypes, type, &std::pair<std::string_view, JointType>::second)->first);
}

ViewJoint viewJoint(const RobotJoint& joint) {
  ViewJoint shown{.name = joint.name,
                  .type = nameOf(joint.type),
                  .parent = joint.parent,
                  .child = joint.child,
                  .rotation = joint.origin.rotation,
                  .translation = joint.origin.translation,
                  .axis = joint.axis,
                  .lower = joint.lower,
                  .upper = joint.upper};
  if (joint.mimic) shown.mimic = ViewMimic{joint.mimic->joint, joint.mimic->multiplier, joint.mimic->offset};
  return shown;
}

/// Names of links with a mesh that was changed so.
std::string linksOf(const RobotModel& model, const FittedRobot& fitted, SolidSource source) {
  std::string names;
  for (std::size_t l = 0; l < fitted.links.size(); ++l)
    if (std::ranges::any_of(fitted.links[l], [&](const RobotPart& part) {
          return part.solid && fitted.solids[*part.solid].source == source;
        }))
      names += (names.empty() ? "" : ", ") + model.links[l].name;
  return names;
}

void addFacts(const RobotModel& model, const FittedRobot& fitted, View& view) {
  view.facts.emplace_back("File", model.file);
  if (const std::string names = linksOf(model, fitted, SolidSource::repaired); !names.empty())
    view.facts.emplace_back("Repaired", names);
  if (const std::string names = linksOf(model, fitted, SolidSource::wrapped); !names.empty())
    view.facts.emplace_back("Wrapped", names);
}

}  // namespace

Result<View> robotView(const RobotModel& model, const std::filesystem::path& urdf, const RobotViewOptions& options,
                       const ProgressCallback& progress) {
  View view{.title = model.name, .facts = {}, .links = {}, .joints = {}, .isMetric = true, .isZUp = true};
  if (std::ranges::all_of(model.links, [](const RobotLink& link) { return link.collisions.empty(); }))
    return Error{fmt::format("{}: no link has a <collision>, so that there is nothing to show; add some", model.file)};
  const Result<FittedRobot> fitted = spheresOf(model, urdf, options, progress);
  if (!fitted) return fitted.error();
  const auto collisions = checkSelfCollision(model, fitted.value(), {options.poses, options.seed}, progress);
  if (!collisions) return collisions.error();
  for (std::uint32_t l = 0; l < model.links.size(); ++l) {
    const Result<TriangleMesh> mesh = meshOf(model, model.links[l], urdf, options.packages);
    if (!mesh) return mesh.error();
    const std::vector<RobotPart>& parts = fitted.value().links[l];
    ViewLink link;
    if (mesh.value().vertices.empty())
      frameSpheres(parts, link);
    else
      link = viewLink(mesh.value());
    link.name = model.links[l].name;
    addSpheres(parts, link);
    view.links.push_back(std::move(link));
  }
  for (const RobotJoint& joint : model.joints) view.joints.push_back(viewJoint(joint));
  view.ignoredPairs = collisions.value().adjacent;
  const auto always = collisions.value().always();
  view.ignoredPairs.insert(view.ignoredPairs.end(), always.begin(), always.end());
  addFacts(model, fitted.value(), view);
  return view;
}

}  // namespace cairn::builder
