// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/fracture.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/core/mix_bits.h"
#include "fracture/bonds.h"
#include "fracture/cut.h"
#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

struct Ball {
  Vec3d center;
  double weight = 0;  // squared radius, slightly changed
};

// Symmetric solids have symmetric trees. Their cuts would run through the mesh's own corners and each other's edges,
// where rounding gives invalid pieces. Weights that differ by about this fraction of the mean move cuts by a few
// hundredths of a per cent of the balls.
constexpr double kWeightSpread = 2e-3;

// Returns a random number in [-1, 1].
double signedRandom(std::uint64_t number) {
  return static_cast<double>(mixBits(number) >> 11) * 0x1p-52 - 1;
}

std::vector<Ball> branchesOf(const SphereTree& tree, std::uint64_t attempt) {
  std::vector<Ball> balls;
  const SphereTreeData& data = tree.data();
  double sum = 0;
  for (std::size_t i = 1; i < data.nodes.size() && data.nodes[i].parent == 0; ++i) {
    const double weight = static_cast<double>(data.nodes[i].radius) * data.nodes[i].radius;
    balls.push_back({data.origin + Vec3d(data.nodes[i].center), weight});
    sum += weight;
  }
  for (std::size_t i = 0; i < balls.size(); ++i)
    balls[i].weight += kWeightSpread * sum / static_cast<double>(balls.size()) * signedRandom(attempt << 32 | (i + 1));
  return balls;
}

// The half-space in which the power distance to `own` is at most that to `other`. Precondition: the centres differ.
HalfSpace nearerTo(const Ball& own, const Ball& other) {
  const Vec3d across = other.center - own.center;
  const double distance = length(across);
  const double along = (distance * distance + own.weight - other.weight) / (2 * distance);
  const Vec3d normal = across * (1 / distance);
  return {normal, dot(normal, own.center) + along};
}

// For balls with one centre, the heavier one takes all; of equal ones the first.
bool isHiddenBy(const std::vector<Ball>& balls, std::size_t i, std::size_t j) {
  if (!(balls[i].center == balls[j].center)) return false;
  return balls[j].weight > balls[i].weight || (balls[j].weight == balls[i].weight && j < i);
}

class Breaking {
 public:
  Breaking(const TriangleMesh& mesh, const SphereTree& tree, std::uint64_t attempt)
      : mesh_(mesh), balls_(branchesOf(tree, attempt)), tolerance_(1e-9 * boundsOf(mesh).diagonal()) {}

  std::size_t branchCount() const { return balls_.size(); }

  Status addBranch(std::size_t i, Fracture& fracture) const {
    std::vector<HalfSpace> spaces;
    for (std::size_t j = 0; j < balls_.size(); ++j) {
      if (j == i) continue;
      if (isHiddenBy(balls_, i, j)) return {};
      if (!(balls_[i].center == balls_[j].center)) spaces.push_back(nearerTo(balls_[i], balls_[j]));
    }
    auto parts = cut(mesh_, spaces);
    if (!parts) return parts.error();
    for (TriangleMesh& part : parts.value()) {
      part.name = fmt::format("{}.{}", mesh_.name, fracture.pieces.size());
      if (const Status sound = checkMesh(part); !sound)
        return Error{fmt::format("cutting the mesh where branch {} ends left an unsound piece ({}); turn or jitter it",
                                 i, sound.error().message)};
      fracture.pieces.push_back(std::move(part));
      fracture.branches.push_back(static_cast<std::uint32_t>(i));
    }
    return {};
  }

  void addBonds(Fracture& fracture) const {
    for (std::uint32_t a = 0; a < fracture.pieces.size(); ++a)
      for (std::uint32_t b = a + 1; b < fracture.pieces.size(); ++b) {
        const std::uint32_t i = fracture.branches[a], j = fracture.branches[b];
        if (i == j) continue;
        const HalfSpace plane = nearerTo(balls_[i], balls_[j]);
        const double area = commonArea(fracture.pieces[a], fracture.pieces[b], plane, tolerance_);
        if (area > tolerance_ * tolerance_) fracture.bonds.push_back({a, b, area});
      }
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<Ball> balls_;
  double tolerance_;  // of corners on a cut, which CGAL rounds to doubles
};

Status checkVolume(const TriangleMesh& mesh, Fracture& fracture) {
  const double whole = signedVolume(mesh);
  double sum = 0;
  for (const TriangleMesh& piece : fracture.pieces) sum += signedVolume(piece);
  fracture.volumeError = std::abs(sum - whole) / whole;
  if (fracture.volumeError <= kMaxVolumeError) return {};
  return Error{
      fmt::format("the pieces' volumes differ from the solid's by {:.1e} of it; turn or jitter the mesh a little",
                  fracture.volumeError)};
}

Result<Fracture> fractureOnce(const TriangleMesh& mesh, const SphereTree& tree, std::uint64_t attempt,
                              const ProgressCallback& progress) {
  const Breaking breaking(mesh, tree, attempt);
  if (breaking.branchCount() < 2) return Error{"the tree has a single branch, so nothing can break off"};
  Fracture fracture;
  for (std::size_t i = 0; i < breaking.branchCount(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(breaking.branchCount());
    if (progress && !progress("cutting", done)) return Error{std::string(kCancelled)};
    if (const Status added = breaking.addBranch(i, fracture); !added) return added.error();
  }
  if (fracture.pieces.size() < 2) return Error{"one branch holds all of the solid, so nothing can break off; use more"};
  if (const Status whole = checkVolume(mesh, fracture); !whole) return whole.error();
  breaking.addBonds(fracture);
  return fracture;
}

}  // namespace

Result<Fracture> fracture(const TriangleMesh& mesh, const SphereTree& tree, const ProgressCallback& progress) {
  if (const Status sound = checkMesh(mesh); !sound) return sound.error();
  constexpr std::uint64_t kAttempts = 4;
  for (std::uint64_t attempt = 0;; ++attempt) {
    Result<Fracture> result = fractureOnce(mesh, tree, attempt, progress);
    if (result || result.error().message == kCancelled || attempt + 1 == kAttempts) return result;
  }
}

}  // namespace cairn::builder
