// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btIDebugDraw.h>

#include <string>
#include <vector>

#include "scenes/pictures/povray.h"

namespace cairn::scenes {

/// Records the lines of Bullet's debug drawing, which a game's own drawer would receive.
class LineRecorder final : public btIDebugDraw {
 public:
  struct Line {
    btVector3 from, to;  ///< world length
    btVector3 color;     ///< red, green, blue, 0 to 1
  };

  std::span<const Line> lines() const { return lines_; }

  void drawLine(const btVector3& from, const btVector3& to, const btVector3& color) override;
  void drawContactPoint(const btVector3& /*point*/, const btVector3& /*normal*/, btScalar /*distance*/,
                        int /*lifeTime*/, const btVector3& /*color*/) override {}
  void reportErrorWarning(const char* /*text*/) override {}
  void draw3dText(const btVector3& /*place*/, const char* /*text*/) override {}
  void setDebugMode(int mode) override { mode_ = mode; }
  int getDebugMode() const override { return mode_; }

 private:
  std::vector<Line> lines_;
  int mode_ = DBG_DrawWireframe;
};

inline constexpr PictureSize kLinePictureSize{1800, 480};

/// Returns a POV-Ray scene of the lines, seen along y with x to the right and z up, framed for `kLinePictureSize`. The
/// ground is dark, as in a game's viewer. Precondition: there are lines.
std::string linePicture(std::span<const LineRecorder::Line> lines);

}  // namespace cairn::scenes
