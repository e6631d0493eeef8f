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

/// Charge for measuring the contact of a leaf pair: both spheres are moved, and compared once more.
inline constexpr std::uint32_t kContactCost = 2 * kSphereUpdateCost + kOverlapTestCost;

/// Ratio of radii up to which a contact of two spheres around whole trees says where the bodies are. Beyond it the
/// small body may be anywhere in the large sphere (`Guards_OnAWideTree.HoldASmallBodyAnywhereWithBoundedWork` fails
/// without a bound).
inline constexpr float kMaxSizeRatio = 2;

/// The arguments of a query to the source meshes.
struct MeshQuery {
  Finest finest;
  ContactKernel& kernel;
  const RelativePlacement& placement;  ///< relative pose of the bodies
  Budget& budget;
  bool mayBeInterrupted;  ///< some step may not have the budget for the meshes
};

/// The partner of a sphere-tree in a pair: it knows how a leaf touches one kind of shape. It owns the traversal of its
/// pair, which may last several steps. In every step the pair places it, then starts or resumes it:
///
///     collider.place(placement);
///     if (!collider.resume()) collider.start(known, skin);
///     collider.traversal().refine(budget);
///     collider.appendContacts(collider.traversal().leafPairs(), contacts);
class Collider {
 public:
  virtual ~Collider() = default;

  /// Forgets all it learnt about the last pair, because a reused collider must answer like a new one.
  virtual void reset() { traversal().abandon(); }
  /// Sets the poses of this step.
  virtual void place(const PairPlacement& placement) = 0;
  /// Begins a new traversal at these poses. `known` are pairs of an earlier traversal that the caller will use again.
  /// Pairs whose element no longer exists are removed, others get new element numbers where needed. `skin` (world
  /// length): how much farther than `maxSeparation` the traversal looks, if `isCacheable`.
  virtual void start(std::vector<NodePair>& known, float skin) = 0;
  /// Whether a finished traversal stays valid while the bodies have moved by less than its skin: the bodies' poses
  /// alone decide which leaves touch.
  virtual bool isCacheable() const { return false; }
  /// Whether the other shape is as it was when last placed. Then contacts stay valid while the bodies are at rest.
  virtual bool isUnchanged(const btCollisionShape& /*other*/) const { return isCacheable(); }
  /// Continues the last traversal at these poses. Returns false if the collider's data does not cover the tree's new
  /// place; the caller must then start anew.
  virtual bool resume() = 0;
  /// The traversal of the pair; it lives as long as the collider.
  virtual Traversal& traversal() = 0;
  const Traversal& traversal() const { return const_cast<Collider*>(this)->traversal(); }
  /// Frees unused memory of a pair at rest; nothing else changes.
  virtual void shrinkToFit() { traversal().shrinkToFit(); }

  /// Appends the contacts of resolved pairs whose separation is below `maxSeparation`. They are measured between the
  /// extreme points of the leaves' regions (scheme S).
  virtual void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) = 0;
  /// Appends contacts as above. Writes to `separations` a lower bound on the separation of each pair's surfaces, minus
  /// infinity where unknown. Precondition: `separations` has one entry for each pair.
  virtual void appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                              std::vector<Contact>& contacts);
  /// Whether contacts are right only if all resolved pairs of a traversal are measured together, even those of earlier
  /// steps. Otherwise pairs resolved in earlier steps keep their remembered contacts.
  virtual bool measuresTogether() const { return false; }
  /// Whether contacts use `RelativeMotion::curvatureCorrection`. They do not where the depth of a leaf decides on which
  /// side of a surface it is.
  virtual bool usesCurvatureCorrection() const { return true; }
  /// The contact of the two bounding spheres, or of the sphere and the element, as they are.
  virtual Contact boundingContact(const NodePair& pair) = 0;
  /// Appends contacts of the sphere around the whole tree, one for each direction in which it meets the collider.
  /// Together they hold it against all of the collider near it. Returns the number of sphere pairs compared. Default:
  /// the contact of the two roots.
  virtual std::uint32_t appendRootContacts(std::vector<Contact>& contacts) {
    contacts.push_back(boundingContact({kRootNode, kRootNode}));
    contacts.back().isRootContact = true;
    return 1;
  }
  /// Whether both are trees with root spheres of similar size. A contact of such roots is coarser than that of any
  /// front.
  virtual bool hasSimilarSize() const { return false; }
  /// Appends contacts of a few points of the body while no newer contact is known. Each contact is true by itself; in
  /// contrast, spheres stand for the whole body and let it turn freely inside. Returns the number of nodes tested.
  /// Default: none.
  virtual std::uint32_t appendCoarse(std::vector<Contact>& /*contacts*/) { return 0; }
  /// Least cosine between the two gradients at a node's middle and at its lowest point. Below it the two face different
  /// sides of something thin, and the lowest point is beyond its middle. A contact there would push the body on through
  /// it.
  static constexpr float kCoarseCosine = 0.5F;
  /// Sets the normals that `alignNormals` returned last, zero for a cluster without one. Call it before anything is
  /// measured in a step. Default: no effect.
  virtual void expect(std::span<const Vec3> /*normals*/) {}
  /// Gives the contacts of one cluster a common normal if their regions are flat, and measures them along it. `lasts`
  /// are the last step's common normals, zero for a cluster without one. Returns the normal, or zero. Contacts that do
  /// not fit the normal get a separation of `maxSeparation`. If they fit another direction, they are also appended
  /// unchanged to `outliers`. Default: nothing is flat.
  virtual Vec3 alignNormals(std::span<Contact> cluster, std::span<const Vec3> lasts, std::vector<Contact>& outliers);

  /// Replaces `appendContacts` for all leaf pairs of a finished traversal where the source meshes can answer. Appends
  /// the contacts and returns a lower bound on the separation of the surfaces (world length), minus infinity where
  /// unknown. Returns nothing, and appends nothing, when the leaf pairs must answer or the budget does not suffice.
  /// Default: nothing.
  virtual std::optional<float> appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts);
  /// Certified distance of the meshes that `appendOfMesh` asks from the sources; world length, 0 for sources.
  virtual float meshError() const { return 0; }
  /// Operations that the source meshes are expected to cost in a step that may be interrupted. It is 0
  /// where meshes are not used or answer at any budget; it is empty where the cost is unknown. Default: 0.
  virtual std::optional<std::uint64_t> expectedMeshCost(const RelativePlacement& /*placement*/) const { return 0; }
  /// The leaf pair to test first next time, for a contact that was reported.
  virtual NodePair leavesOf(const Contact& contact) const { return contact.pair; }

  /// Diagonal of the shape's box, world length; infinite for shapes without a size.
  virtual float size(const btCollisionShape& shape) const = 0;
};

}  // namespace cairn::bullet
