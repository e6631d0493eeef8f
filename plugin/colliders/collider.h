// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cairn/bullet/step.h"
#include "cairn/core/traversal.h"
#include "contacts/contact.h"
#include "kernel/contact_kernel.h"
#include "placement/pair_placement.h"

class btCollisionShape;

namespace cairn::bullet {

/// What measuring the contact of a leaf pair is charged: both spheres are moved, and compared once more.
inline constexpr std::uint32_t kContactCost = 2 * kSphereUpdateCost + kOverlapTestCost;

/// How many times larger than the other, by radius, a sphere around a whole tree may be for their contact to say
/// anything about where the bodies are: beyond, the small body may be anywhere in it
/// (`Guards_OnAWideTree.HoldASmallBodyAnywhereWithBoundedWork` fails without a bound).
inline constexpr float kMaxSizeRatio = 2;

/// What is asked of the source meshes.
struct MeshQuestion {
  Finest finest;
  ContactKernel& kernel;
  const RelativePlacement& placement;  ///< how the bodies stand to each other
  Budget& budget;
  bool mayBeInterrupted;  ///< some step may not get to it
};

/// What a sphere-tree meets. A collider owns the traversal of its pair, which may live for several steps, and knows
/// how a leaf touches it. It is placed anew in every step, then either started or resumed.
class Collider {
 public:
  virtual ~Collider() = default;

  /// Forgets what it learnt about the bodies it served: a pooled pair must answer like a new one.
  virtual void reset() { traversal().abandon(); }
  /// Takes the poses of this step.
  virtual void place(const PairPlacement& placement) = 0;
  /// Begins a new traversal at these poses. `known` are pairs of an earlier traversal that the caller will ask about
  /// again: those whose element no longer exists are removed, others are renamed if need be. `skin` (world length):
  /// how much farther than the placement's reach it looks, if `isCacheable`.
  virtual void start(std::vector<NodePair>& known, float skin) = 0;
  /// Whether what a traversal found holds for all poses that are no farther from its own than its skin: nothing but the
  /// bodies' poses decides what touches.
  virtual bool isCacheable() const { return false; }
  /// Whether the other shape is what it was when it was last placed: then contacts of its surface last while the bodies
  /// lie still.
  virtual bool isUnchanged(const btCollisionShape& /*other*/) const { return isCacheable(); }
  /// Goes on with the last traversal at these poses. False when it cannot (what it has seen of the collider is too
  /// small for where the tree now is): the caller must start anew.
  virtual bool resume() = 0;
  virtual Traversal& traversal() = 0;
  const Traversal& traversal() const { return const_cast<Collider*>(this)->traversal(); }
  /// Frees memory that is not in use, for a pair that rests; nothing else changes.
  virtual void shrinkToFit() { traversal().shrinkToFit(); }

  /// Appends the contacts of resolved pairs, measured between the extreme points of the leaves' regions (scheme S), if
  /// their gap is below the placement's reach.
  virtual void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) = 0;
  /// The same, and says in `separations` how far the two surfaces of each pair are apart at least; minus infinity where
  /// that is not known. Precondition: one gap for each pair.
  virtual void appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                              std::vector<Contact>& contacts);
  /// Whether the contacts of a traversal that took several steps are only right when all its resolved pairs are
  /// measured together; otherwise those of earlier steps are left at what was remembered of them.
  virtual bool measuresTogether() const { return false; }
  /// Whether contacts give way to what bends away, see `RelativeMotion::curvatureCorrection`. Not where it depends on
  /// how deep a leaf sinks on which side of a surface it is.
  virtual bool usesCurvatureCorrection() const { return true; }
  /// The contact of the two bounding spheres (or of the sphere and the element) as they are.
  virtual Contact boundingContact(const NodePair& pair) = 0;
  /// Appends contacts of the sphere around the whole tree that hold it against all of the collider there is near it,
  /// one for each direction it meets some in. Returns the pairs of spheres compared for it. Default: that of the two
  /// roots.
  virtual std::uint32_t appendRootContacts(std::vector<Contact>& contacts) {
    contacts.push_back(boundingContact({kRootNode, kRootNode}));
    contacts.back().isRootContact = true;
    return 1;
  }
  /// Whether both are trees whose spheres around the whole are of like size: what these say is coarser than any front.
  virtual bool isOfLikeSize() const { return false; }
  /// While nothing newer is known: appends contacts of a few points of the body, each true, whatever others would say.
  /// Spheres stand in for all of it, and let it turn in them as it likes. Returns the nodes asked. Default: none.
  virtual std::uint32_t appendCoarse(std::vector<Contact>& /*contacts*/) { return 0; }
  /// Between what the middle of a node and its lowest point see of the other surface. Where these see different sides
  /// of it, the point is deeper than the middle of something thin: it would push the body on, through it.
  static constexpr float kCoarseCosine = 0.5F;
  /// The common normals that `alignNormals` gave last, zero where a cluster had none: to be told before anything is
  /// measured in a step. Default: nothing is flat.
  virtual void expect(std::span<const Vec3> /*normals*/) {}
  /// Gives the contacts of one cluster a common normal if their regions are flat, and measures them along it. `lasts`
  /// are the pair's common normals of the step before, zero where a cluster had none; returns the normal given, or
  /// zero. Those that do not belong to that direction are left at the reach, and appended to `outliers` as they were if
  /// they belong to another one. Default: nothing is flat.
  virtual Vec3 alignNormals(std::span<Contact> cluster, std::span<const Vec3> lasts, std::vector<Contact>& outliers);

  /// In place of `appendContacts` for all leaf pairs of a traversal that is done, where the source meshes can tell:
  /// appends the contacts, and returns how far the surfaces are apart at least
  /// (world length), minus infinity where that is not known. Nothing, and nothing appended, when the leaf pairs have to
  /// be asked, or the budget does not cover triangles that the question asks for. Default: nothing.
  virtual std::optional<float> appendOfMesh(const MeshQuestion& question, std::vector<Contact>& contacts);
  /// Operations that the source meshes are expected to take in a step that may be interrupted, 0 where they are not
  /// asked or answer whatever is left; nothing where that is not known. Default: 0.
  virtual std::optional<std::uint64_t> expectedMeshCost(const RelativePlacement& /*placement*/) const { return 0; }
  /// The leaf pair to be asked first next time, of a contact that was told.
  virtual NodePair leavesOf(const Contact& contact) const { return contact.pair; }

  /// Diagonal of such a shape's box, world length; infinite when it has no size of its own to speak of.
  virtual float size(const btCollisionShape& shape) const = 0;
};

enum class ColliderKind : std::uint8_t { tree, plane, convex, triangles, field, terrain };
inline constexpr int kColliderKinds = 6;

/// What a shape is treated as; nothing for what is neither convex nor a distance field nor can show its triangles:
/// compounds, soft bodies and GImpact compounds.
std::optional<ColliderKind> kindOf(const btCollisionShape& shape);

std::unique_ptr<Collider> makeCollider(ColliderKind kind);

}  // namespace cairn::bullet
