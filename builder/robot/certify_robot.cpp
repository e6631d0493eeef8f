// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "cairn/builder/certify_balls.h"
#include "certify/left_out.h"
#include "robot/collect_parts.h"
#include "robot/parallel_jobs.h"
#include "robot/placing.h"
#include "robot/solid_cover.h"

namespace cairn::builder {
namespace {

bool areEqual(const CollisionShape& a, const CollisionShape& b) {
  bool same = a.kind == b.kind && a.size == b.size && a.origin.translation == b.origin.translation;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d unit;
    unit[axis] = 1;
    same = same && a.origin.rotation * unit == b.origin.rotation * unit;
  }
  return same;
}

/// A link of the robot, and what stands for its shapes.
struct LinkTask {
  std::uint32_t link = 0;
  std::vector<const RobotPart*> parts;  // not kept
  std::vector<Ball> balls;              // link's frame
};

/// Takes the spheres of a link that are not shapes of the robot's own, and tells which of those are kept. Fails where
/// another shape is left.
Result<std::vector<Ball>> newSpheres(const RobotLink& link, const RobotLink& other, const std::string& file,
                                     std::vector<bool>& isKept) {
  std::vector<Ball> balls;
  for (const CollisionShape& shape : other.collisions) {
    bool isOld = false;
    for (std::size_t c = 0; c < link.collisions.size() && !isOld; ++c)
      if (shape.kind != CollisionKind::mesh && !isKept[c] && areEqual(shape, link.collisions[c]))
        isOld = isKept[c] = true;
    if (isOld) continue;
    if (shape.kind != CollisionKind::sphere)
      return Error{
          fmt::format("{}: link '{}' has another shape than spheres and the robot's own boxes and cylinders, of "
                      "which nothing can be proved; give the URDF that holds the spheres",
                      file, link.name)};
    balls.push_back({shape.origin.translation, shape.size.x, 0});
  }
  return balls;
}

Result<std::vector<LinkTask>> tasksOf(const RobotModel& robot, const FittedRobot& collected,
                                      const RobotModel& spheres) {
  std::vector<LinkTask> tasks;
  for (std::uint32_t l = 0; l < robot.links.size(); ++l) {
    const RobotLink& link = robot.links[l];
    if (link.collisions.empty()) continue;
    const auto other = std::ranges::find(spheres.links, link.name, &RobotLink::name);
    if (other == spheres.links.end())
      return Error{fmt::format("{}: there is no link '{}'; give spheres of the same robot", spheres.file, link.name)};
    std::vector<bool> isKept(link.collisions.size(), false);
    auto balls = newSpheres(link, *other, spheres.file, isKept);
    if (!balls) return balls.error();
    LinkTask task{l, {}, std::move(balls).value()};
    for (const RobotPart& part : collected.links[l])
      if (part.solid && !isKept[part.collision]) task.parts.push_back(&part);
    if (task.parts.empty()) continue;
    if (task.balls.empty())
      return Error{fmt::format("{}: link '{}' has no spheres that stand for its shapes", spheres.file, link.name)};
    tasks.push_back(std::move(task));
  }
  return tasks;
}

/// A link's balls in the frame of a part's solid. `growth` of 1 makes them hold the balls as they are, of -1 makes them
/// lie inside, whatever the way rounds and however the part deviates from the solid's image.
std::vector<Ball> inSolid(const std::vector<Ball>& balls, const RobotPart& part, const CollisionShape& shape,
                          double growth) {
  const RigidPose toShape = shape.origin.inverse();
  std::vector<Ball> result;
  for (const Ball& ball : balls) {
    const Vec3d center = toShape(ball.center);
    const double slack = placingRounding(ball.center, shape.origin.translation, ball.radius) + part.deviation;
    const Ball moved{
        {center.x * part.signs.x, center.y * part.signs.y, center.z * part.signs.z}, ball.radius + growth * slack, 0};
    if (moved.radius > 0) result.push_back(moved);
  }
  return result;
}

/// Of one part: what the balls leave out of its surface.
double leftOut(const std::vector<Ball>& balls, const RobotPart& part, const RobotSolid& solid,
               const CollisionShape& shape, const ProgressCallback& asks) {
  const std::vector<Ball> inside = inSolid(balls, part, shape, -1);
  if (inside.empty()) return std::numeric_limits<double>::infinity();
  const TriangleMesh& surface = solid.source == SolidSource::cylinder ? solid.solid : solid.surface;
  const LeftOutTolerance tolerance{0.01, 1e-4 * boundsOf(surface).diagonal()};
  return surfaceLeftOut(inside, surface, tolerance, [&] { return !asks || asks("certifying", 0); }).upper;
}

Result<LinkCertificate> certify(const LinkTask& task, const RobotModel& robot, const FittedRobot& collected,
                                const ProgressCallback& asks) {
  const RobotLink& link = robot.links[task.link];
  LinkCertificate certificate{link.name, static_cast<std::uint32_t>(task.balls.size())};
  std::vector<double> out(task.balls.size(), std::numeric_limits<double>::infinity());
  for (const RobotPart* part : task.parts) {
    const RobotSolid& solid = collected.solids[*part->solid];
    const CollisionShape& shape = link.collisions[part->collision];
    certificate.leavesOut = std::max(certificate.leavesOut, leftOut(task.balls, *part, solid, shape, asks));
    const auto proof = certifyBalls(inSolid(task.balls, *part, shape, 1), solid.solid, asks);
    if (!proof) return proof.error();
    // A point of the solid's image is within twice the deviation of the part's own solid, see `placeCover`.
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = std::min(out[i], proof.value().balls[i].protrusion.upper + solid.offOriginal + 2 * part->deviation);
    certificate.isChanged |= solid.source == SolidSource::repaired || solid.source == SolidSource::wrapped;
  }
  certificate.sticksOut = *std::ranges::max_element(out);
  return certificate;
}

}  // namespace

Result<std::vector<LinkCertificate>> certifyRobot(const RobotModel& robot, const std::filesystem::path& urdf,
                                                  const RobotModel& spheres,
                                                  const std::map<std::string, std::filesystem::path>& packages,
                                                  const ProgressCallback& progress) {
  RobotOptions options;
  options.packages = packages;
  options.primitives = true;
  const auto collected = collectParts(robot, urdf, options, progress);
  if (!collected) return collected.error();
  const auto tasks = tasksOf(robot, collected.value(), spheres);
  if (!tasks) return tasks.error();
  std::vector<LinkCertificate> certificates(tasks.value().size());
  const Status done = runJobs(certificates.size(), {"certifying", kCollected, 1}, progress,
                              [&](std::size_t i, const ProgressCallback& asks) -> Status {
                                auto proved = certify(tasks.value()[i], robot, collected.value(), asks);
                                if (!proved) return proved.error();
                                certificates[i] = std::move(proved).value();
                                return {};
                              });
  if (!done) return done.error();
  return certificates;
}

}  // namespace cairn::builder
