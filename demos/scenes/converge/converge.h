// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// What happens when bodies meet on their way to the centre.
enum class Meeting : std::uint8_t {
  through,  ///< nothing: each flies on as if it were alone
  bounce,   ///< they collide as exact meshes (GImpact with a margin of 0.1 % of body size), independent of
            ///< every shape under test: thesis 7.2
};

Result<Meeting> parseMeeting(std::string_view name);
const char* meetingName(Meeting meeting);

struct ConvergeOptions {
  std::uint32_t bodies = 20;   ///< at least 1
  std::uint32_t runs = 5;      ///< each with its own random starts, at least 1
  std::uint32_t frames = 300;  ///< a run, 1/60 s each
  std::uint64_t seed = 1;
  Meeting meeting = Meeting::bounce;
};

/// How all bodies of a scene moved, frame by frame, so that any number of shapes can be asked about the same poses.
struct Recording {
  std::uint32_t bodies = 0, runs = 0, framesPerRun = 0;
  std::vector<BodyMotion> motions;  ///< of each body, frame by frame, run by run

  std::span<const BodyMotion> frame(std::uint32_t run, std::uint32_t frame) const;
  /// Over all motions: equal for equal bits.
  std::string hash() const;
};

/// Scene B, thesis 7.2: bodies at random places on a sphere, at random orientations and not touching, fly to its centre
/// at random speeds and spins; no gravity. The sphere has room for the bodies and they arrive one third to two thirds
/// through a run of 300 frames. A pure function of model and options; the first bodies of a run do not depend on how
/// many follow.
Result<Recording> recordConverge(const Model& model, const ConvergeOptions& options);

}  // namespace cairn::scenes
