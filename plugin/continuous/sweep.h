// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cairn/core/budget.h"
#include "continuous/face_overlap.h"
#include "continuous/swept_frame.h"
#include "continuous/swept_target.h"
#include "continuous/trajectory.h"
#include "continuous/tree_parts.h"

namespace cairn::bullet {

/// A sphere-tree and the shape that it may meet within a step.
struct SweptPair {
  const SphereTreeShape* tree;
  const btCollisionShape* other;
  Trajectory treeTrajectory, otherTrajectory;
  btVector3 origin;  ///< of the pair frame, in the world
  /// Surfaces nearer than this now, a world length, get ordinary contacts instead.
  float maxSeparation = 0;
  bool isFast = true;   ///< false for a body that has become slow: then only bodies that have sunk in are looked for
  int otherIndex = -1;  ///< the other's index among its compound's children, -1 for none
};

/// Finds what a body meets within a step, leaf by leaf: continuous collision by speculative contacts. Each leaf that
/// would pass through a surface by the end of the step becomes a speculative contact (`Contact::isSpeculative`). Its
/// plane is the one that separates the two regions for the longest time. The solver lets each leaf come as far as its
/// plane, and all together stop the body at the first meeting. See docs/algorithms/continuous.md.
///
///     Sweep sweep(makeSweptTarget(kind));
///     for (const Contact& contact : sweep.run(pair, budget)) ...;
///
/// A body that has sunk in all the same is found again. A sweep remembers the bodies' poses from when nothing had sunk
/// in (the anchor). It starts from there until nothing is sunk in again. Of two trees the smaller one is moved.
///
/// Cost: at most `kMaxTests` pairs of nodes a step, charged even beyond the budget; after that, nodes stand for their
/// leaves. Buffers are kept; make one object for each fast pair.
class Sweep {
 public:
  static constexpr std::uint32_t kMaxTests = 1U << 16;

  /// `target`: empty yet, for shapes of the pair's kind.
  explicit Sweep(std::unique_ptr<SweptTarget> target) : target_(std::move(target)) {}

  /// The speculative contacts, in the pair frame. Each direction of search gives at most one for each leaf of the
  /// smaller tree. A leaf with too large an error may have one for each triangle. Their order depends on the pair
  /// alone. Valid until the next run.
  const std::vector<Contact>& run(const SweptPair& pair, Budget& budget);
  /// Whether a body has sunk in, or may do so in this step. Then `run` must be called in the next step too.
  bool isAnchored() const { return anchor_.has_value(); }
  /// Forgets the anchor: the bodies were placed elsewhere.
  void forget() { anchor_.reset(); }

 private:
  // Fraction of the smaller part's radius. A part no deeper than this still counts as in front, as sliding parts are.
  static constexpr float kSunkFraction = 0.1F;
  // A part of the step in which the tree hardly turns against the other.
  struct Segment {
    float from, to;  // fractions of the step; below 0 on the way from the anchor, which has length 1
    btTransform treeInFrame;
    TreeParts tree, treeAtEnd;
    float chord;  // 2 sin(t/2) for the angle t of its rotation
    float bow;    // bound on how far its middle is beside its straight path
    Mat3 otherAxes, otherAxesAtEnd;
    float otherSlack;  // bound on how far the other's points move by its rotation
  };
  // A part of the tree in a segment: its ball at the start, its straight displacement, and the slack. No point of the
  // part is farther beside the displacement than the slack.
  struct MovedNode {
    Sphere ball;
    Vec3 displacement;
    float slack = 0;
  };
  static MovedNode moved(const Segment& segment, TreeParts::Part part);
  struct Candidate {
    float entry;
    NodePair pair;
    // Greatest on top of the heap: the earliest.
    friend bool operator<(const Candidate& x, const Candidate& y) {
      if (x.entry != y.entry) return x.entry > y.entry;
      return x.pair.a != y.pair.a ? x.pair.a > y.pair.a : x.pair.b > y.pair.b;
    }
  };
  // The first surface that a part of the moved tree meets. On the way from the anchor, it is no contact if the part is
  // still in front of the surface.
  static constexpr float kNotMet = 2;  // beyond any fraction of the step
  struct Meeting {
    static constexpr std::size_t kMaxBeside = FaceOverlap::kMax - 1;
    float at = kNotMet;
    bool isContact = false;
    bool isAsked = false;  // it was tested as a floor
    NodePair nodes;
    Vec3 normal;  // in the frame
    Contact contact;
    // Offsets from the first contact to more contacts of the same two regions.
    std::array<Vec3, kMaxBeside> beside{};
    std::size_t besideCount = 0;
  };
  struct Hit {
    float at = 0;  // fraction of the segment
    Vec3 normal;
    float closing = 0;  // along the normal, in the whole segment
  };

  // A face of either side that stops a body, at its place at the beginning of the step.
  struct Floor {
    NodePair nodes;
    Vec3 normal;  // from the other side to the tree
    float at;     // when it is reached; below 0 if a body has sunk into it
    bool isTrees;
    float height;  // along the normal
  };
  // Faces of one body that are known at that time.
  static constexpr std::size_t kMaxFloors = 4;

  void cut(const SweptPair& pair, bool fromAnchor);
  void append(const SweptPair& pair, float from, float to, btScalar turn);
  Segment segment(const SweptPair& pair, float from, float to) const;
  SweptPlace placeAt(float part) const;
  void sweep(const SweptPair& pair, Budget& budget);
  void follow(const SweptPair& pair, bool fromAnchor, Budget& budget);
  void deflect(SweptPair pair, Budget& budget);
  const Meeting* firstMeeting() const;
  void markSecondary();
  void addContactsOf(const Meeting& meeting);
  static void swapSides(Contact& contact);
  void search(const SweptPair& pair, const Segment& segment, Budget& budget);
  void enter(const Segment& segment, const NodePair& pair);
  const Meeting* meetingOf(TreeParts::Part part) const;
  Meeting& makeMeeting(TreeParts::Part part);
  void addTriangleMeetings(NodeId leaf, std::uint32_t count);
  bool isPastFirstHit(TreeParts::Part part, float at) const;
  bool split(const Segment& segment, const Candidate& candidate, Budget& budget);
  // The vector from the other side's farthest point along a unit direction of the frame to the tree's farthest point
  // against it.
  Vec3 apartAlong(const Vec3& normal, const NodePair& nodes, const TreeParts& tree, const Mat3& otherAxes) const;
  // The separation of two regions along a unit direction of the frame; negative where they overlap.
  float separationAlong(const Vec3& normal, const NodePair& nodes, const TreeParts& tree, const Mat3& otherAxes) const;
  struct Approach;
  std::size_t collectNormals(const Approach& approach);
  Hit flattest(const Approach& approach, Hit latest, std::size_t ofOther) const;
  std::optional<Hit> hitOf(const SweptPair& pair, const Segment& segment, const Candidate& candidate);
  // A point of each side, with the tree at the segment's start, and all known common points on the other side.
  struct Points {
    Vec3 onTree, onOther;
    FaceOverlap place;
  };
  Points pointsOf(const SweptPair& pair, const Segment& segment, const NodePair& nodes, const Hit& hit) const;
  void note(const SweptPair& pair, const Segment& segment, const NodePair& nodes, const Hit& hit);
  Meeting meetingAt(const SweptPair& pair, const Segment& segment, const NodePair& nodes, const Hit& hit);
  void keepAboveFloors(const SweptPair& pair);
  void keepAbove(const Floor& floor, const SweptPair& pair, const Segment& start);
  void noteSunk(const Segment& start, const NodePair& nodes);
  void noteSunkInto(bool isTrees, const Segment& start, const NodePair& nodes);
  void keepOffSunkFloors(const SweptPair& pair, const Segment& start);
  bool isEdgeOf(const Floor& floor, const Segment& start, const Meeting& meeting);
  const Meeting* nextMeeting();
  void markTested(const Vec3& normal);
  void collectFaces(bool ofTree, const Segment& start, const NodePair& nodes);
  bool isFace(bool ofTree, const Segment& start, const NodePair& nodes, const Vec3& normal);
  float heightOf(bool ofTree, const Segment& start, const NodePair& nodes, const Vec3& normal) const;
  bool isLevel(const Floor& floor, const Segment& start, const NodePair& nodes) const;
  bool isInFront(const Floor& floor, const Segment& start, const NodePair& nodes, float maxSeparation) const;
  bool standsOn(const Floor& floor, const Segment& start, const Meeting& meeting, float maxSeparation);
  void meetFloor(const Floor& floor, const SweptPair& pair, Meeting& meeting);

  std::unique_ptr<SweptTarget> target_;
  std::vector<Segment> segments_;
  std::vector<Candidate> heap_;
  // By node of the moved tree, its index in `meetings_`, or kNone. For a split leaf, it is minus one minus the index of
  // its first triangle's meeting.
  std::vector<int> meetingOf_;
  std::vector<Meeting> meetings_;
  std::vector<Contact> contacts_;
  std::vector<Floor> sunkFloors_;
  SeparatingNormals normals_;
  float margin_ = 0;                 // of the moved tree
  float otherReach_ = 0;             // distance of the other side's farthest point from its own origin
  std::optional<SweptFrame> frame_;  // of the motion followed last
  std::uint32_t tests_ = 0;
  int slowSteps_ = 0;                 // since the pair was last fast
  std::optional<SweptPlace> anchor_;  // pose of both when nothing had sunk in
};

}  // namespace cairn::bullet
