// SPDX-License-Identifier: Zlib
#include "continuous/swept_triangles.h"

#include "placement/bullet_math.h"

namespace cairn::bullet {

void SweptTriangles::take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) {
  soup_.gather(static_cast<const btConcaveShape&>(shape), lower, upper);
  elements_.clear();
  for (const TriangleSoup::Source& source : soup_.triangles())
    elements_.emplace_back(Triangle{toVec3(source.corners[0]), toVec3(source.corners[1]), toVec3(source.corners[2])});
}

float SweptTriangles::radius(std::uint32_t element) const {
  return 0.5F * length(elements_[element].upper - elements_[element].lower);
}

std::optional<float> SweptTriangles::entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const {
  return elements_[element].entry(ball, displacement);
}

Vec3 SweptTriangles::support(std::uint32_t element, const Vec3& direction) const {
  return supportOf(elements_[element].triangle, direction);
}

void SweptTriangles::appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) {
  elements_[element].appendNormals(center, normals);
}

void SweptTriangles::name(std::uint32_t element, Contact& contact) const {
  contact.id.otherPart = soup_.triangles()[element].part;
  contact.id.otherIndex = soup_.triangles()[element].index;
}

}  // namespace cairn::bullet
