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

/// The behaviour of bodies that meet on their way to the centre.
enum class Meeting : std::uint8_t {
  through,  ///< they ignore each other and fly on
  bounce,  ///< they collide as exact meshes (GImpact, margin of 0.1 % of body size), independent of every tested shape:
           ///< thesis 7.2 every shape under test: thesis 7.2
};

Result<Meeting> parseMeeting(std::string_view name);
const char* meetingName(Meeting meeting);

struct ConvergeOptions {
  std::uint32_t bodies = 20;   ///< at least 1
  std::uint32_t runs = 5;      ///< each with its own random starts, at least 1
  std::uint32_t frames = 300;  ///< per run, 1/60 s each
  std::uint64_t seed = 1;
  Meeting meeting = Meeting::bounce;
};

/// The motions of all bodies of a scene, frame by frame. Any number of shapes can be tested on the same poses.
struct Recording {
  std::uint32_t bodies = 0, runs = 0, framesPerRun = 0;
  std::vector<BodyMotion> motions;  ///< of each body, frame by frame, run by run

  std::span<const BodyMotion> frame(std::uint32_t run, std::uint32_t frame) const;
  /// Returns a hash of all motions; equal bits give equal hashes.
  std::string hash() const;
};

/// Records scene B (thesis 7.2): bodies fly to the centre of a sphere. They start at random places on it, at random
/// orientations and not touching. Speeds and spins are random; there is no gravity. The sphere has room for the bodies,
/// which arrive one third to two thirds through a run of 300 frames. A pure function of model and options. The first
/// bodies of a run do not depend on the number of later ones.
///
///     Recording recording = recordConverge(model, {.bodies = 20}).value();
Result<Recording> recordConverge(const Model& model, const ConvergeOptions& options);

}  // namespace cairn::scenes
