// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <vector>

#include "cairn/core/budget.h"
#include "continuous/face_overlap.h"
#include "continuous/swept_frame.h"
#include "continuous/swept_target.h"
#include "continuous/trajectory.h"
#include "continuous/tree_parts.h"

namespace cairn::bullet {

/// A sphere-tree and what it may meet within a step.
struct SweptPair {
  const SphereTreeShape* tree;
  const btCollisionShape* other;
  Trajectory treeTrajectory, otherTrajectory;
  btVector3 origin;         ///< of the pair frame, in the world
  float maxSeparation = 0;  ///< what is nearer than this now is left to the contacts of where the bodies are
  bool isFast = true;       ///< or slow again: only what has sunk in is looked for
  int otherIndex = -1;      ///< which child of a compound the other is, -1 for none
};

/// Finds what a body runs into within a step, leaf by leaf: continuous collision by speculative contacts. Each leaf
/// that would be passed through by the end of the step becomes a contact ahead (`Contact::isSpeculative`), with the
/// plane that keeps the two regions apart for longest. The solver then lets each come as far as that plane, and all
/// together stop the body wherever it is met first. See docs/algorithms/continuous.md.
///
/// What has sunk in nevertheless is found again: a sweep remembers where the bodies stood when nothing had, and goes by
/// way of there until that is so again. Of two trees the smaller one is moved.
///
/// Work: at most `kMaxTests` pairs of nodes a step, charged whatever is left of the budget; beyond that nodes stand for
/// their leaves. Buffers are kept; one for each pair that is fast.
class Sweep {
 public:
  static constexpr std::uint32_t kMaxTests = 1U << 16;

  explicit Sweep(ColliderKind kind) : target_(makeSweptTarget(kind)) {}

  /// The contacts ahead, pair frame, in each direction it is looked in at most one for each leaf of the smaller tree,
  /// or for each triangle of a leaf that says too little, in an order that depends on nothing but the pair. Valid until
  /// the next run.
  const std::vector<Contact>& run(const SweptPair& pair, Budget& budget);
  /// Whether something had sunk in, or might in this step: it has to be run in the next as well.
  bool isAnchored() const { return anchor_.has_value(); }
  /// The bodies were set down elsewhere.
  void forget() { anchor_.reset(); }

 private:
  // Of the smaller part's radius: so deep it may be already and still be in front, as what slides is.
  static constexpr float kSunkFraction = 0.1F;
  // A part of the step in which the tree hardly turns against the other.
  struct Segment {
    float from, to;  // parts of the step; below 0 on the way from the anchor, which is as long as one
    btTransform treeInFrame;
    TreeParts tree, treeAtEnd;
    float chord;  // 2 sin(t/2) for the angle by which it turns
    float bow;    // how far its middle may be beside its straight way
    Mat3 otherAxes, otherAxesAtEnd;
    float otherSlack;  // how far the other's points may come by its turning
  };
  // One part of the tree in a segment: where it begins, its straight way, and how far any of its points may be beside
  // that.
  struct MovedNode {
    Sphere ball;
    Vec3 displacement;
    float slack = 0;
  };
  static MovedNode moved(const Segment& segment, TreeParts::Part part);
  struct Candidate {
    float entry;
    NodePair pair;
    // Greatest on top of a heap: the earliest.
    friend bool operator<(const Candidate& x, const Candidate& y) {
      if (x.entry != y.entry) return x.entry > y.entry;
      return x.pair.a != y.pair.a ? x.pair.a > y.pair.a : x.pair.b > y.pair.b;
    }
  };
  // What a part of the moved tree comes to first: on the way from the anchor, no contact if it is still in front of it.
  static constexpr float kNotMet = 2;  // beyond any part of the step
  struct Meeting {
    static constexpr std::size_t kMaxBeside = FaceOverlap::kMax - 1;
    float at = kNotMet;
    bool isContact = false;
    bool isAsked = false;  // whether it is a floor
    NodePair nodes;
    Vec3 normal;  // in the frame
    Contact contact;
    // More contacts of the same two regions: so far beside the first.
    std::array<Vec3, kMaxBeside> beside{};
    std::size_t besideCount = 0;
  };
  struct Hit {
    float at = 0;  // part of the segment
    Vec3 normal;
    float closing = 0;  // along it, in the whole segment
  };

  // A face of either side that something is stopped by, where it is as the step begins.
  struct Floor {
    NodePair nodes;
    Vec3 normal;  // from the other side to the tree
    float at;     // when it is reached; below 0 if something has sunk into it
    bool isTrees;
    float height;  // along the normal
  };
  // Faces of one body that are known by then.
  static constexpr std::size_t kMaxFloors = 4;

  void cut(const SweptPair& pair, bool fromAnchor);
  void append(const SweptPair& pair, float from, float to, btScalar turn);
  Segment segment(const SweptPair& pair, float from, float to) const;
  SweptPlace placeAt(float part) const;
  void sweep(const SweptPair& pair, Budget& budget);
  void follow(const SweptPair& pair, bool fromAnchor, Budget& budget);
  void deflect(SweptPair pair, Budget& budget);
  const Meeting* firstMeeting() const;
  void markLater();
  void addContactsOf(const Meeting& meeting);
  static void swapSides(Contact& contact);
  void search(const SweptPair& pair, const Segment& segment, Budget& budget);
  void enter(const Segment& segment, const NodePair& pair);
  const Meeting* meetingOf(TreeParts::Part part) const;
  Meeting& makeMeeting(TreeParts::Part part);
  void makeMeetingsBelow(NodeId leaf, std::uint32_t count);
  bool isPastFirstHit(TreeParts::Part part, float at) const;
  bool split(const Segment& segment, const Candidate& candidate, Budget& budget);
  // From the other side's farthest point along a unit direction of the frame to the tree's farthest against it.
  Vec3 apartAlong(const Vec3& normal, const NodePair& nodes, const TreeParts& tree, const Mat3& otherAxes) const;
  // How far apart two regions are along a unit direction of the frame; negative if they are not.
  float separationAlong(const Vec3& normal, const NodePair& nodes, const TreeParts& tree, const Mat3& otherAxes) const;
  struct Approach;
  std::size_t collectNormals(const Approach& approach);
  Hit flattest(const Approach& approach, Hit latest, std::size_t ofOther) const;
  std::optional<Hit> hitOf(const SweptPair& pair, const Segment& segment, const Candidate& candidate);
  // A point of each, where the tree is at the segment's beginning, and all of the other's that are known.
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
  void answer(const Vec3& normal);
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
  // By node of the moved tree, which of them; kNone, or for a leaf that was split minus one more than the first of
  // those of its triangles.
  std::vector<int> meetingOf_;
  std::vector<Meeting> meetings_;
  std::vector<Contact> contacts_;
  std::vector<Floor> sunkFloors_;
  SeparatingNormals normals_;
  float margin_ = 0;                 // of the moved tree
  float otherReach_ = 0;             // of the other side's farthest point, from its own origin
  std::optional<SweptFrame> frame_;  // of the last way followed
  std::uint32_t tests_ = 0;
  int slowSteps_ = 0;                 // since it was last fast
  std::optional<SweptPlace> anchor_;  // where both stood when nothing had sunk in
};

}  // namespace cairn::bullet
