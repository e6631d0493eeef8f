// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "cairn/core/vec3.h"
#include "scenes/pictures/povray.h"

namespace cairn::scenes {

/// The mesh axis that points up in a picture.
enum class UpAxis : std::uint8_t { y, z };

struct MeshView {
  UpAxis up = UpAxis::y;
  double turnDegrees = 30;  ///< of the mesh about its up axis
};

/// The frame of a mesh in picture units: diagonal 1, bounding box centred, turned and tilted. x points right, z up; the
/// view is along +y.
class PictureFrame {
 public:
  /// Precondition: at least two different vertices.
  PictureFrame(std::span<const Vec3d> vertices, const MeshView& view);

  /// Picture units per mesh unit.
  double scale() const { return scale_; }
  Vec3d operator()(const Vec3d& p) const;

 private:
  struct Angle {
    double cosine, sine;
  };

  UpAxis up_;
  Angle turn_, tilt_;
  Vec3d center_;
  double scale_;
};

/// The common parts of pictures of spheres, as pieces of a POV-Ray scene in picture units.

/// Camera, light and textures `BodyTexture`, `Matt`: a picture of this width and height around `middle` (a height).
std::string spherePreamble(double width, double height, double middle);
/// A sphere coloured by its error, a fraction of the size.
std::string sphereText(const Vec3d& center, double radius, double errorFraction, double transmit);
/// A heading and a line below it, centred at a point of the picture plane.
std::string labelText(const std::string& heading, const std::string& line, double x, double z);
/// The colour scale of errors, centred at this height.
std::string colorScaleText(double z);

}  // namespace cairn::scenes
