// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "contacts/contact.h"
#include "placement/pair_placement.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// Contacts of a tree's flat leaves with triangles of a smaller body, which may stand in a leaf's middle, far from the
/// leaf's support points. The contacts measure how high these triangles are over those of the leaf's region, along its
/// faces' normals. All triangles are flat, so corners of both and crossings of edges suffice.
///
///     TrianglesOnFaces onFaces;
///     onFaces.append(placement, size, triangles, pairs, isComplete, contacts);
///
/// A body on the other side of the tree is deep behind a face. So the class remembers two depths for each plane: the
/// deepest point in front, and the shallowest behind. A body placed inside the tree has no such record. It leaves
/// through the planes that it crosses least deep.
class TrianglesOnFaces {
 public:
  /// Whether the leaf is flat and has few triangles, because no budget covers them.
  static bool isFor(const PlacedTree& tree, NodeId leaf);

  /// Forgets all planes.
  void reset() { seen_.clear(); }

  /// Appends the contacts whose separation is below the placement's `maxSeparation`, without ids. `pairs`: of leaves
  /// with `isFor`, sorted by leaf. `triangles` (pair frame): indexed by b of the pairs. `size`: of the shape they
  /// belong to, world length. `isComplete`: the step has no more pairs. Cost: linear in the pairs, plus the pairs near
  /// a face's plane times the leaf's triangles.
  void append(const PairPlacement& placement, float size, std::span<const Triangle> triangles,
              std::span<const NodePair> pairs, bool isComplete, std::vector<Contact>& contacts);

 private:
  // Cosine of the 120 degrees beyond which two faces are opposite sides, not those of a groove.
  static constexpr float kOppositeCosine = -0.5F;
  static constexpr float kNothing = -std::numeric_limits<float>::infinity();

  // A side of the prism over a triangle along its face's normal.
  struct Side {
    Vec3 inwards;  // unit, or zero where the triangle has no such side
    float offset;
  };
  // A triangle of the leaf's region.
  struct Own {
    Vec3 corner, normal;
    std::array<Side, 3> sides;
    float height;  // the least, along the face
    bool isOver(const Vec3& point, float slack) const;
  };
  // A leaf's triangles in one plane, and the contacts over them.
  struct Face {
    Vec3 outwards;     // pair frame
    float offset = 0;  // of the plane, along `outwards`
    std::size_t owns = 0, ownsEnd = 0;
    std::size_t begin = 0, end = 0;  // in `found_`
    bool isCrossed = false;          // a triangle stands on both sides of it
    bool isCrossedOnRim = false;     // the same, with triangles on the rims included
    float deepest = 0;               // the lowest separation over any face of the plane
    bool isNew = false;              // the plane was not known before
    bool wasTouched = false;
    float threshold = 0;  // a lower separation is behind the face
    // The lowest separation among reported contacts that belong to no other face.
    float ownDeepest = std::numeric_limits<float>::infinity();
  };
  // A contact of `face` in `found_` that belongs to another face.
  struct Owned {
    std::size_t found;
    const Face* face;
    Vec3 owner;  // `outwards` of that face
  };
  // The depths in front of a plane, and behind it, in the last step.
  struct Seen {
    Vec3 outwards;  // the tree's axes
    float offset;   // world length
    float front;    // the deepest separation in front, at most 0
    float behind;   // the shallowest separation behind, or `kNothing`
    bool isTouched;
  };

  void addFaces(const PlacedTree& tree, NodeId leaf, const Vec3& outwards);
  void addOwns(const PlacedTree& tree, NodeId leaf, Face& face);
  void look(const PairPlacement& placement, Face& face, std::span<const Triangle> triangles,
            std::span<const NodePair> pairs);
  static bool isWellOver(const Own& own, std::span<const Contact> points, float tolerance);
  void compare(const Face& face, const Own& own, const Triangle& other, const NodePair& pair);
  std::span<const Own> ownsOf(const Face& face) const;
  std::span<const Contact> ofFace(const Face& face) const;

  void decide(const PairPlacement& placement, float size);
  float thresholdOf(const Seen& last, float tolerance, float size) const;
  float deepestInFront(const Face& face) const;
  bool isFarSide(const Face& face, float tolerance) const;
  void gatherPlanes();
  bool isOfOnePlane(const Face& one, const Face& other) const;
  void bringOut(float maxSeparation, float alsoTo);
  bool isSpanned(const Face& face) const;
  void crossOnRims(float alsoTo);
  // Index in `seen_`; its size if the plane is not known.
  std::size_t placeOf(const PlacedTree& tree, const Face& face) const;
  void remember(const PlacedTree& tree, float maxSeparation, bool isComplete);

  const Face* ownerOf(const Face& face, const Contact& contact, float maxSeparation) const;
  const Face* acrossEdge(const Face& face, const Contact& contact, float maxSeparation) const;
  static bool turnToEdge(const Face& face, const Face& other, const Triangle& triangle, Contact& contact);
  void appendInFront(std::span<const Triangle> triangles, float maxSeparation, std::vector<Contact>& contacts);
  float reportedFrom(const Face& face, float maxSeparation);
  void report(const Face& face, Contact contact, std::span<const Triangle> triangles, float maxSeparation,
              std::vector<Contact>& contacts);

  float margin_ = 0;
  float flush_ = 0;           // a body may reach this far beyond a plane without crossing it
  float planeTolerance_ = 0;  // by which offsets of one plane may differ
  std::vector<Own> owns_;
  std::vector<Face> faces_;
  std::vector<Contact> found_;
  std::vector<bool> onRim_;  // for each of `found_`
  std::vector<Owned> owned_;
  std::vector<Vec3> owners_;
  std::vector<Contact> onBorders_;  // triangles that meet edges with their borders only
  std::vector<Seen> seen_;
};

}  // namespace cairn::bullet
