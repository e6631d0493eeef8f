// SPDX-License-Identifier: Zlib
//
// Decides which points in front of a leaf's faces are reported, and along which normal where two faces meet.
#include <algorithm>
#include <limits>

#include "contacts/face_limits.h"
#include "triangles/triangles_on_faces.h"

namespace cairn::bullet {

namespace {

// Difference of cosines by which a normal may miss the range between two others and still count as within it.
constexpr float kBesideEnds = 0.01F;
// Length of the sum of two faces' normals. Below it, at half a degree, they are the two sides of a plate and meet in no
// edge. Rounding would decide where its middle is. The limit is small, because blades are sharp too.
constexpr float kPlateSum = 0.01F;

}  // namespace

// Where two faces meet, a point that has sunk a little through one of them is far behind the other. It belongs to the
// first.
const TrianglesOnFaces::Face* TrianglesOnFaces::ownerOf(const Face& face, const Contact& contact,
                                                        float maxSeparation) const {
  if (contact.separation >= -maxSeparation) return nullptr;
  const Vec3 onOther = contact.onCollider();
  const auto owner = std::ranges::find_if(faces_, [&](const Face& other) {
    if (dot(other.outwards, face.outwards) >= kSameFaceCosine) return false;
    const float separation = dot(other.outwards, onOther) - other.offset - margin_;
    if (separation < other.threshold || separation >= maxSeparation || separation <= contact.separation + maxSeparation)
      return false;
    return std::ranges::any_of(ownsOf(other), [&](const Own& own) { return own.isOver(onOther, 0); });
  });
  return owner == faces_.end() ? nullptr : &*owner;
}

// Another face that the point touches as well: the two meet there.
const TrianglesOnFaces::Face* TrianglesOnFaces::acrossEdge(const Face& face, const Contact& contact,
                                                           float maxSeparation) const {
  const Vec3 onOther = contact.onCollider();
  const auto across = std::ranges::find_if(faces_, [&](const Face& other) {
    if (dot(other.outwards, face.outwards) >= kSameFaceCosine) return false;
    if (lengthSq(other.outwards + face.outwards) < kPlateSum * kPlateSum) return false;
    const float separation = dot(other.outwards, onOther) - other.offset - margin_;
    if (separation < other.threshold || std::abs(separation - contact.separation) > maxSeparation) return false;
    return std::ranges::any_of(ownsOf(other), [&](const Own& own) { return own.isOver(onOther, maxSeparation); });
  });
  return across == faces_.end() ? nullptr : &*across;
}

// At an edge, a triangle that lies on it touches along the triangle's own normal, if this is between the two faces'
// normals. Returns true then. Otherwise it touches along the middle of the two normals, and the result is false.
bool TrianglesOnFaces::turnToEdge(const Face& face, const Face& other, const Triangle& triangle, Contact& contact) {
  const Vec3 middle = unitVector(face.outwards + other.outwards), onOther = contact.onCollider();
  Vec3 own = triangle.normal();
  if (dot(own, middle) < 0) own = -own;
  const bool isOfEdge = lengthSq(own) > 0 && dot(own, middle) >= dot(face.outwards, middle) - kBesideEnds;
  contact.normal = isOfEdge ? -own : -middle;
  contact.position = onOther + contact.normal * (0.5F * contact.separation);
  return isOfEdge;
}

void TrianglesOnFaces::appendInFront(std::span<const Triangle> triangles, float maxSeparation,
                                     std::vector<Contact>& contacts) {
  onBorders_.clear();
  owned_.clear();
  const std::size_t first = contacts.size();
  for (Face& face : faces_)
    for (std::size_t i = face.begin; i < face.end; ++i) {
      const Contact& contact = found_[i];
      if (contact.separation < face.threshold || contact.separation >= maxSeparation) continue;
      if (const Face* const owner = ownerOf(face, contact, maxSeparation)) {
        owned_.push_back({i, &face, owner->outwards});
        continue;
      }
      face.ownDeepest = std::min(face.ownDeepest, contact.separation);
      report(face, contact, triangles, maxSeparation, contacts);
    }
  float from = 0;
  for (std::size_t i = 0; i < owned_.size(); ++i) {
    const Face& face = *owned_[i].face;
    const Contact& contact = found_[owned_[i].found];
    if (i == 0 || &face != owned_[i - 1].face) from = reportedFrom(face, maxSeparation);
    if (contact.separation >= from) report(face, contact, triangles, maxSeparation, contacts);
  }
  // A triangle that meets an edge only with its border adds nothing near a triangle that lies on the edge.
  const std::size_t count = contacts.size() - first;
  for (const Contact& contact : onBorders_) {
    const auto isBeside = [&](const Contact& reported) {
      return lengthSq(reported.position - contact.position) <= 4 * maxSeparation * maxSeparation;
    };
    if (std::ranges::none_of(std::span(contacts).subspan(first, count), isBeside)) contacts.push_back(contact);
  }
}

// The separation from which on contacts of `face` are reported that belong to other faces. A body touches the face
// inside it, or on borders at opposite sides (a crate on another). Then it stands on the face, and contacts up to the
// border count. Deeper ones stand beside the face, as a saddle's legs do.
float TrianglesOnFaces::reportedFrom(const Face& face, float maxSeparation) {
  float deepest = std::numeric_limits<float>::infinity(), shallowest = kNothing;
  for (const Face& other : faces_)
    if (isOfOnePlane(other, face)) deepest = std::min(deepest, other.ownDeepest);
  if (deepest < std::numeric_limits<float>::infinity()) return deepest - maxSeparation;
  bool isBetween = false;
  owners_.clear();
  for (const Owned& owned : owned_) {
    if (!isOfOnePlane(*owned.face, face)) continue;
    shallowest = std::max(shallowest, found_[owned.found].separation);
    const auto cosine = [&](const Vec3& other) { return dot(other, owned.owner); };
    isBetween =
        isBetween || std::ranges::any_of(owners_, [&](const Vec3& other) { return cosine(other) < kOppositeCosine; });
    if (std::ranges::none_of(owners_, [&](const Vec3& other) { return cosine(other) >= kSameFaceCosine; }))
      owners_.push_back(owned.owner);
  }
  return isBetween ? shallowest - maxSeparation : std::numeric_limits<float>::infinity();
}

void TrianglesOnFaces::report(const Face& face, Contact contact, std::span<const Triangle> triangles,
                              float maxSeparation, std::vector<Contact>& contacts) {
  const Face* const other = acrossEdge(face, contact, maxSeparation);
  const bool isClear = !other || turnToEdge(face, *other, triangles[contact.pair.b], contact);
  (isClear ? contacts : onBorders_).push_back(contact);
}

}  // namespace cairn::bullet
