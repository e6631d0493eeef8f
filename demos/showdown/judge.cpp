// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge of all engines: reads poses of a closed mesh, and measures the meshes themselves with the exact check of
// demos/scenes/truth (CGAL), which shares no code with any engine. Usage: showdown_judge FRAMES.json
//   {"vertices": [x, y, z...], "indices": [...], "faces": [[nx, ny, nz, offset]...], "gapsFrom": 0, "frames": [[x, y,
//   z, qx, qy, qz, qw...]...]}
// Prints for each frame depth, gap and depth in the pit's faces, as fractions of the mesh's size. A body whose pose
// holds null, as JSON has numbers that are none, is nowhere: it is counted, and nothing is measured of it. Frames
// before `gapsFrom`, which may be left out, get no gaps.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "scenes/figures/spread.h"
#include "scenes/truth/exact_check.h"
#include "scenes/truth/placed_body.h"

namespace {

using cairn::Vec3d;
using cairn::scenes::ExactSurface;
using cairn::scenes::PlacedBody;
using Json = nlohmann::ordered_json;

constexpr double kTolerance = 0.0005;  // of depths, fraction of size
constexpr double kNear = 0.1;          // fraction of size: farther bodies are not measured, their gap is this

struct Face {
  Vec3d normal;
  double offset = 0;
};

struct Frame {
  std::vector<btTransform> poses;
  int nowhere = 0;      // bodies without one
  bool hasGaps = true;  // are asked for, which takes most of the time
};

struct Question {
  cairn::scenes::Model model;  // without a tree, which nobody asks here
  std::vector<Face> faces;
  std::vector<Frame> frames;
};

double numberOf(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Frame frameOf(const Json& json) {
  Frame frame;
  std::vector<btScalar> numbers;
  for (const auto& number : json) numbers.push_back(btScalar(numberOf(number)));
  for (std::size_t i = 0; i + 6 < numbers.size(); i += 7) {
    const btQuaternion rotation(numbers[i + 3], numbers[i + 4], numbers[i + 5], numbers[i + 6]);
    const bool isFinite = std::all_of(&numbers[i], &numbers[i] + 7, [](btScalar x) { return std::isfinite(x); });
    if (isFinite && rotation.length2() > 0)
      frame.poses.emplace_back(rotation.normalized(), btVector3(numbers[i], numbers[i + 1], numbers[i + 2]));
    else
      ++frame.nowhere;
  }
  return frame;
}

Question read(const Json& json) {
  Question question;
  const auto coordinates = json.at("vertices").get<std::vector<double>>();
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    question.model.vertices.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  const auto indices = json.at("indices").get<std::vector<std::uint32_t>>();
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    question.model.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  for (const auto& face : json.at("faces")) question.faces.push_back({{face[0], face[1], face[2]}, face[3]});
  for (const auto& frame : json.at("frames")) {
    question.frames.push_back(frameOf(frame));
    question.frames.back().hasGaps = question.frames.size() > json.value("gapsFrom", std::size_t(0));
  }
  return question;
}

double sizeOf(const std::vector<Vec3d>& vertices) {
  Vec3d low = vertices.at(0), high = vertices.at(0);
  for (const Vec3d& v : vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  return length(high - low);
}

class Judge {
 public:
  Judge(const ExactSurface& surface, const Question& question)
      : surface_(surface), question_(question), size_(question.model.size) {}

  Json judge(const Frame& frame) {
    bodies_.clear();
    for (const btTransform& pose : frame.poses) bodies_.push_back(placeBody(pose, question_.model));
    gaps_.assign(bodies_.size(), kNear * size_);
    cairn::scenes::SpreadOfLengths depths, faceDepths;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (const double depth = -clearance(i); depth > 0) faceDepths.add(depth);
      for (std::size_t j = i + 1; j < bodies_.size(); ++j)
        if (const double depth = depthOf(i, j); depth > 0) depths.add(depth);
    }
    Json answer = {{"depth", toJson(depths)}, {"pitDepth", toJson(faceDepths)}, {"nowhere", frame.nowhere}};
    if (frame.hasGaps) answer["gap"] = gaps();
    return answer;
  }

 private:
  Json gaps() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) closeGap(i);
    cairn::scenes::SpreadOfLengths lengths;
    for (const double gap : gaps_) lengths.add(gap);
    return toJson(lengths);
  }

  Json toJson(const cairn::scenes::SpreadOfLengths& lengths) const {
    const cairn::scenes::Spread spread = lengths.over(size_);
    return {{"mean", spread.mean}, {"max", spread.max}, {"pairs", spread.pairs}};
  }

  bool areNear(std::size_t i, std::size_t j) const {
    cairn::scenes::Box grown = bodies_[i].box;
    const Vec3d room = Vec3d{1, 1, 1} * (kNear * size_);
    grown.lower = grown.lower - room;
    grown.upper = grown.upper + room;
    return grown.overlaps(bodies_[j].box);
  }

  cairn::scenes::Placement relative(std::size_t i, std::size_t j) const {
    return relativePlacement(bodies_[i].worldFromBody, bodies_[j].worldFromBody);
  }

  // Of the body over the nearest face; its gap is no more.
  double clearance(std::size_t i) {
    double least = std::numeric_limits<double>::infinity();
    for (const Face& face : question_.faces)
      for (const Vec3d& v : bodies_[i].vertices) least = std::min(least, dot(face.normal, v) - face.offset);
    gaps_[i] = std::min(gaps_[i], std::max(least, 0.0));
    return least;
  }

  // Solids whose surfaces do not meet are apart, or one is inside the other with each of its vertices.
  bool areApart(const cairn::scenes::Placement& placement) const {
    if (surfacesMeet(surface_, surface_, placement)) return false;
    const Vec3d vertex = question_.model.vertices.at(0);
    return surface_.depth(placement * vertex) <= 0 && surface_.depth(placement.inverse() * vertex) <= 0;
  }

  double depthOf(std::size_t i, std::size_t j) {
    if (!bodies_[i].box.overlaps(bodies_[j].box)) return 0;
    const cairn::scenes::Placement placement = relative(i, j);
    if (areApart(placement)) return 0;
    const double depth = mutualPenetration(surface_, surface_, placement, kTolerance * size_);
    if (depth > 0) gaps_[i] = gaps_[j] = 0;
    return depth;
  }

  // What touches nothing so far may be near something.
  void closeGap(std::size_t i) {
    for (std::size_t j = 0; j < bodies_.size() && gaps_[i] > 0; ++j)
      if (j != i && areNear(i, j)) gaps_[i] = std::min(gaps_[i], surfaceDistance(surface_, surface_, relative(i, j)));
  }

  const ExactSurface& surface_;
  const Question& question_;
  double size_;
  std::vector<PlacedBody> bodies_;
  std::vector<double> gaps_;  // of each body to what is nearest, m
};

int answer(const char* path) {
  std::ifstream file(path);
  if (!file) return std::fprintf(stderr, "showdown_judge: %s cannot be read.\n", path), 1;
  Question question = read(Json::parse(file));
  question.model.size = sizeOf(question.model.vertices);
  const auto surface = ExactSurface::create(question.model.vertices, question.model.triangles);
  if (!surface) return std::fprintf(stderr, "showdown_judge: %s\n", surface.error().message.c_str()), 1;
  Judge judge(surface.value(), question);
  Json answers = Json::array();
  for (const auto& frame : question.frames) answers.push_back(judge.judge(frame));
  std::puts(answers.dump().c_str());
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return std::fprintf(stderr, "usage: showdown_judge FRAMES.json\n"), 2;
  try {
    return answer(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "showdown_judge: %s: %s\n", arguments[1], error.what());
    return 1;
  }
}
