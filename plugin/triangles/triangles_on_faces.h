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

/// Contacts of a tree's flat leaves with the triangles of something smaller, which may stand in a leaf's middle, far
/// from all its support points: how high the triangles stand over those of the leaf's own region, seen along its faces'
/// normals. All are flat, so what counts are corners of either and where edges cross.
///
/// Seen along a face, what stands on the other side of the body lies deep behind it. Which points are in front of a
/// plane and which behind is remembered as how deep those in front were, and how deep, at least, those behind. Of what
/// was set down in the tree nothing is remembered: it comes out of the planes it crosses least deep.
class TrianglesOnFaces {
 public:
  /// Whether the leaf is flat, and of few triangles, as no budget covers them.
  static bool isFor(const PlacedTree& tree, NodeId leaf);

  /// Forgets where anything was.
  void reset() { seen_.clear(); }

  /// Appends what is below the placement's reach, without ids. `pairs`: of leaves for which `isFor`, ordered by leaf;
  /// `triangles`, pair frame, are what their b names; `size`: world length, of what they make. `isComplete`: there are
  /// no more pairs in this step. Cost: the pairs, and those of them that are near a face's plane times the leaf's
  /// triangles.
  void append(const PairPlacement& placement, float size, std::span<const Triangle> triangles,
              std::span<const NodePair> pairs, bool isComplete, std::vector<Contact>& contacts);

 private:
  // Cosine of the 120 degrees from which on two faces are opposite sides rather than those of a groove.
  static constexpr float kOppositeCosine = -0.5F;
  static constexpr float kNothing = -std::numeric_limits<float>::infinity();

  // Into the prism over a triangle along its face's normal.
  struct Side {
    Vec3 inwards;  // unit, or zero where the triangle has no such side
    float offset;
  };
  // A triangle of a region.
  struct Own {
    Vec3 corner, normal;
    std::array<Side, 3> sides;
    float height;  // the least, along the face
    bool isOver(const Vec3& point, float slack) const;
  };
  // Those of a leaf's triangles that lie in one plane, and what stands over them.
  struct Face {
    Vec3 outwards;     // pair frame
    float offset = 0;  // of the plane, along that
    std::size_t owns = 0, ownsEnd = 0;
    std::size_t begin = 0, end = 0;  // in `found_`
    bool isCrossed = false;          // something stands on both sides of it
    bool isCrossedOnRim = false;     // the same, of what is on the rims of its triangles as well
    float deepest = 0;               // the lowest gap over any face of the plane
    bool isNew = false;              // nothing is known of the plane from before
    bool wasTouched = false;
    float threshold = 0;                                        // of gaps; what is below is behind
    float ownDeepest = std::numeric_limits<float>::infinity();  // of what is told and belongs to no other
  };
  // Of a face, in `found_`, but belonging to another.
  struct Owned {
    std::size_t found;
    const Face* face;
    Vec3 owner;  // its outwards
  };
  // What was in front of a plane, and behind it.
  struct Seen {
    Vec3 outwards;  // the tree's axes
    float offset;   // world length
    float front;    // the deepest gap in front, at most 0
    float behind;   // the least deep one behind, or `kNothing`
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
  // In `seen_`; its size where nothing is known of the plane.
  std::size_t placeOf(const PlacedTree& tree, const Face& face) const;
  void remember(const PlacedTree& tree, float maxSeparation, bool isComplete);

  const Face* ownerOf(const Face& face, const Contact& contact, float maxSeparation) const;
  const Face* acrossEdge(const Face& face, const Contact& contact, float maxSeparation) const;
  static bool turnToEdge(const Face& face, const Face& other, const Triangle& triangle, Contact& contact);
  void appendInFront(std::span<const Triangle> triangles, float maxSeparation, std::vector<Contact>& contacts);
  float stoodOnFrom(const Face& face, float maxSeparation);
  void tell(const Face& face, Contact contact, std::span<const Triangle> triangles, float maxSeparation,
            std::vector<Contact>& contacts);

  float margin_ = 0;
  float flush_ = 0;           // by which what reaches beyond a plane does not cross it
  float planeTolerance_ = 0;  // by which offsets of one plane may differ
  std::vector<Own> owns_;
  std::vector<Face> faces_;
  std::vector<Contact> found_;
  std::vector<bool> onRim_;  // of `found_`
  std::vector<Owned> owned_;
  std::vector<Vec3> owners_;
  std::vector<Contact> onBorders_;  // of what stands over them, at edges
  std::vector<Seen> seen_;
};

}  // namespace cairn::bullet
