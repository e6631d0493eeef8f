// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

/// Free space between neighbours of the column, as a fraction of body size. Half of it serves for irregular positions.
constexpr double kClearanceFraction = 0.05;

/// Layers grow with the number of bodies, so that the column is about three times as tall as it is wide.
std::uint32_t bodiesPerSide(std::uint32_t bodies) {
  return std::max(2U, static_cast<std::uint32_t>(std::lround(std::cbrt(bodies / 3.0))));
}

double spacing(const Model& model) {
  return 2 * model.reach + kClearanceFraction * model.size;
}

/// The pit is wide enough for the column or the given start. The heap lies about a third as deep as the pit is wide.
double pitHalfWidth(const Model& model, const HeapOptions& options) {
  constexpr double kPacking = 0.5;  // approximate solid share of a heap
  constexpr double kDepthPerHalfWidth = 0.7;
  const double volume = model.tree->mass().volume * model.scale * model.scale * model.scale;
  const double heapHalfWidth = std::cbrt(options.bodies * volume / kPacking / (4 * kDepthPerHalfWidth));
  double startHalfWidth = options.start.empty() ? spacing(model) * bodiesPerSide(options.bodies) / 2 : 0;
  for (const btTransform& pose : options.start)
    for (int axis = 0; axis < 2; ++axis)
      startHalfWidth = std::max(startHalfWidth, std::abs(static_cast<double>(pose.getOrigin()[axis])) + model.reach);
  return std::max(heapHalfWidth, startHalfWidth);
}

}  // namespace

Viewer heapViewer(const Pit& pit) {
  constexpr double kAway = 3;  // in half widths
  constexpr double kFieldOfView = std::numbers::pi / 3;
  Viewer viewer;
  viewer.focus = Vec3d(0, 0, pit.halfWidth() / 3);
  const Vec3d towards = normalized(Vec3d(0.50, -1.0, 0.58));  // direction of the pictures' camera
  viewer.eye = viewer.focus + towards * (kAway * pit.halfWidth());
  viewer.direction = -towards;
  viewer.fieldOfView = kFieldOfView;
  return viewer;
}

Result<std::unique_ptr<Heap>> Heap::create(const Model& model, const HeapOptions& options) {
  assert(options.bodies > 0 && (options.start.empty() || options.start.size() == options.bodies));
  auto heap = std::unique_ptr<Heap>(new Heap(model, options));
  WorldOptions worldOptions = options.world;
  if (options.isWatched) worldOptions.viewer = heapViewer(heap->pit_);
  if (const Status begun = heap->begin(worldOptions, options.shape); !begun) return begun.error();
  options.start.empty() ? heap->dropBodies(options) : heap->placeBodies(options);
  return heap;
}

Heap::Heap(const Model& model, const HeapOptions& options)
    : BodyScene(model, options.world.budget, options.stepsWithoutBudget),
      bodiesPerSide_(bodiesPerSide(options.bodies)),
      pit_(pitHalfWidth(model, options)) {}

Heap::~Heap() {
  end();
}

void Heap::placeBodies(const HeapOptions& options) {
  double height = 0;
  for (const btTransform& pose : options.start)
    height = std::max(height, static_cast<double>(pose.getOrigin().z()) + model().reach);
  pit_.build(ownWorld(), options.world.shape, height);
  for (const btTransform& pose : options.start) ownWorld().addBody(shape(), pose, 1, model().inertia);
}

void Heap::dropBodies(const HeapOptions& options) {
  const double step = spacing(model());
  const std::uint32_t perLayer = bodiesPerSide_ * bodiesPerSide_;
  const double columnHeight = step * (options.bodies / perLayer + 1);
  pit_.build(ownWorld(), options.world.shape, columnHeight);

  const double columnHalfWidth = step * bodiesPerSide_ / 2;
  const double jitter = kClearanceFraction * model().size / 2;
  for (std::uint32_t i = 0; i < options.bodies; ++i) {
    Random random(options.seed, i);
    const std::uint32_t inLayer = i % perLayer;
    const Vec3d place =
        Vec3d(inLayer % bodiesPerSide_ + 0.5, inLayer / bodiesPerSide_ + 0.5, i / perLayer + 0.5) * step -
        Vec3d(columnHalfWidth, columnHalfWidth, 0);
    const btQuaternion rotation = random.rotation();
    ownWorld().addBody(shape(), btTransform(rotation, toBullet(place + random.direction() * jitter)), 1,
                       model().inertia);
  }
}

double Heap::clearance(const PlacedBody& body, const ExactSurface&, std::size_t part) const {
  const HalfSpace face = pit_.faces()[part];
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : body.vertices) least = std::min(least, dot(face.normal, p) - face.offset);
  return least;
}

std::uint32_t Heap::countLost() const {
  const auto isLost = [&](const btRigidBody* body) {
    const Vec3d center = fromBullet(body->getWorldTransform().getOrigin());
    if (!isFinite(center)) return true;
    return std::ranges::any_of(
        pit_.faces(), [&](const HalfSpace& face) { return dot(face.normal, center) < face.offset - model().size / 2; });
  };
  return static_cast<std::uint32_t>(std::ranges::count_if(world().bodies(), isLost));
}

}  // namespace cairn::scenes
