// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/heap_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/pictures/povray.h"

namespace cairn::scenes {
namespace {

/// Muted stone and earth colours, sRGB. They differ in lightness, so readers with a colour vision deficiency can
/// distinguish them.
constexpr std::array<const char*, 7> kPalette = {"<0.36,0.55,0.66>", "<0.93,0.76,0.47>", "<0.82,0.45,0.33>",
                                                 "<0.53,0.66,0.50>", "<0.93,0.89,0.80>", "<0.33,0.38,0.47>",
                                                 "<0.72,0.62,0.70>"};

constexpr const char* kPreamble = R"(#version 3.7;
global_settings { assumed_gamma 1 }
#declare Stone = finish { ambient 0.05 diffuse 0.85 specular 0.10 roughness 0.04 }
#declare Wall = texture { pigment { srgb <0.83,0.82,0.80> } finish { ambient 0.05 diffuse 0.8 } }
background { srgb <0.86,0.88,0.90> }
)";

/// Lights spread over the sky in a Fibonacci spiral with the cosine law of a soft sky. Together they shade every
/// concavity like an overcast sky, without the blotches of sampled indirect light.
std::string skyLights(double distance) {
  constexpr int kLights = 32;
  constexpr double kTotal = 0.95;
  std::string text;
  for (int i = 0; i < kLights; ++i) {
    const double height = std::sqrt((i + 0.5) / kLights);
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double flat = std::sqrt(1 - height * height);
    text += fmt::format("light_source {{ {} rgb <0.93,0.97,1.0>*{:.4g} }}\n",
                        povrayVector(Vec3d{flat * std::cos(azimuth), flat * std::sin(azimuth), height} * distance),
                        kTotal / kLights);
  }
  return text;
}

/// Height of the heap's top, so that the camera frames the whole heap.
double topOf(const Heap& heap) {
  double top = heap.model().size;
  for (const btRigidBody* body : heap.world().bodies())
    top = std::max(top, static_cast<double>(body->getWorldTransform().getOrigin().z()) + heap.model().reach / 2);
  return top;
}

/// The distance keeps the pit's corners in the picture, which is twice as wide as high.
std::string cameraAndLights(double halfWidth, double top) {
  constexpr double kHalfAngle = 8.5 * std::numbers::pi / 180;  // vertical
  const Vec3d direction = normalized(Vec3d{0.50, -1.0, 0.58});
  const double halfHeight =
      halfWidth * std::numbers::sqrt2 * direction.z + top / 2 * std::hypot(direction.x, direction.y);
  const Vec3d target{0, 0, top * 0.25};
  const Vec3d lamp = Vec3d{-2.4, -2.6, 5.0} * std::max(halfWidth, top);
  return fmt::format(
      "camera {{ location {} sky z right -x*image_width/image_height look_at {} angle {:.4g} }}\n"
      "light_source {{ {} rgb <1.0,0.91,0.78>*1.05 area_light x*{:.4g}, y*{:.4g}, 7, 7 adaptive 1 jitter circular "
      "orient }}\n",
      povrayVector(target + direction * (1.06 * halfHeight / std::tan(kHalfAngle))), povrayVector(target),
      2 * 180 / std::numbers::pi * std::atan(2 * std::tan(kHalfAngle)), povrayVector(lamp), halfWidth * 1.4,
      halfWidth * 1.4);
}

/// Ground and the two walls behind the heap; those towards the camera are left out.
std::string pitText(double w, double wallHeight) {
  const double thickness = 0.08 * w;
  return fmt::format(
      "box {{ <{0:.4g},{0:.4g},{1:.4g}>, <{2:.4g},{2:.4g},0> texture {{ Wall }} }}\n"
      "box {{ <{0:.4g},{0:.4g},0>, <{3:.4g},{2:.4g},{4:.4g}> texture {{ Wall }} }}\n"
      "box {{ <{3:.4g},{5:.4g},0>, <{2:.4g},{2:.4g},{4:.4g}> texture {{ Wall }} }}\n"
      "plane {{ z, {1:.4g} pigment {{ srgb <0.84,0.83,0.81> }} finish {{ ambient 0 diffuse 0.8 }} }}\n",
      -w - thickness, -thickness, w, -w, wallHeight, w);
}

std::string bodyText(const btTransform& pose, const char* colour) {
  const btMatrix3x3& m = pose.getBasis();
  // POV-Ray multiplies row vectors: its rows are the columns of ours.
  return fmt::format(
      "object {{ Body matrix <{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.6g},{:.6g},{:.6g}> "
      "pigment {{ srgb {} }} finish {{ Stone }} }}\n",
      m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2], pose.getOrigin().x(),
      pose.getOrigin().y(), pose.getOrigin().z(), colour);
}

}  // namespace

std::string heapPicture(const Heap& heap) {
  const double halfWidth = heap.pit().halfWidth();
  const double top = topOf(heap);
  std::string text = kPreamble;
  text += cameraAndLights(halfWidth, top) + skyLights(20 * std::max(halfWidth, top));
  text += pitText(halfWidth, top * 0.75);
  text += povrayMesh("Body", heap.model().vertices, heap.model().triangles);
  std::size_t i = 0;
  for (const btRigidBody* body : heap.world().bodies())
    text += bodyText(body->getWorldTransform(), kPalette[i++ % kPalette.size()]);
  return text;
}

}  // namespace cairn::scenes
