// SPDX-License-Identifier: Zlib
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/tree_file.h"
#include "placement/bullet_math.h"
#include "serialize/tree_chunks.h"

namespace cairn::bullet {

namespace {

// While a file is written, a chunk is named by its memory, as in btCompoundShape. The memory is unique and lives until
// the file is finished.
struct NewChunk {
  btChunk* chunk;
  void* memory;
};

NewChunk allocate(btSerializer& serializer, std::size_t size, int count) {
  btChunk* chunk = serializer.allocate(size, count);
  return {chunk, chunk->m_oldPtr};
}

std::uint64_t nameInFile(btSerializer& serializer, const void* what) {
  return reinterpret_cast<std::uintptr_t>(serializer.getUniquePointer(const_cast<void*>(what)));
}

// Not written as a shape chunk: Bullet's importer would make a second shape of each, beside the compound's child.
btCollisionShapeData* writeSphere(btSerializer& serializer, float radius) {
  const NewChunk chunk = allocate(serializer, sizeof(btConvexInternalShapeData), 1);
  auto* sphere = new (chunk.memory) btConvexInternalShapeData{};
  sphere->m_collisionShapeData.m_shapeType = SPHERE_SHAPE_PROXYTYPE;
  std::fill_n(sphere->m_localScaling.m_floats, 3, 1.0F);
  sphere->m_implicitShapeDimensions.m_floats[0] = radius;
  sphere->m_collisionMargin = radius;
  serializer.finalizeChunk(chunk.chunk, "btConvexInternalShapeData", BT_ARRAY_CODE, chunk.memory);
  return static_cast<btCollisionShapeData*>(serializer.getUniquePointer(chunk.memory));
}

btCompoundShapeChildData* writeSpheres(const SphereTreeShape& shape, const std::vector<NodeId>& nodes,
                                       btSerializer& serializer) {
  const NewChunk chunk = allocate(serializer, sizeof(btCompoundShapeChildData), static_cast<int>(nodes.size()));
  auto* child = static_cast<btCompoundShapeChildData*>(chunk.memory);
  for (const NodeId node : nodes) {
    const Sphere sphere = shape.tree().sphere(node);
    const btScalar radius = btScalar(sphere.radius) * shape.scale() + shape.getMargin();
    new (child) btCompoundShapeChildData{};
    const btVector3 center = shape.bodyFromTree() * (toBullet(sphere.center) * shape.scale());
    btTransform(btMatrix3x3::getIdentity(), center).serializeFloat(child->m_transform);
    child->m_childShape = writeSphere(serializer, static_cast<float>(radius));
    child->m_childShapeType = SPHERE_SHAPE_PROXYTYPE;
    child->m_childMargin = static_cast<float>(radius);
    ++child;
  }
  serializer.finalizeChunk(chunk.chunk, "btCompoundShapeChildData", BT_ARRAY_CODE, chunk.memory);
  return static_cast<btCompoundShapeChildData*>(serializer.getUniquePointer(chunk.memory));
}

void writeBytes(btSerializer& serializer, const void* bytes, std::size_t size, int code, const void* what) {
  const NewChunk chunk = allocate(serializer, 1, static_cast<int>(size));
  std::memcpy(chunk.memory, bytes, size);
  serializer.finalizeChunk(chunk.chunk, kPlainBytes, code, const_cast<void*>(what));
}

void writeTree(btSerializer& serializer, const SphereTree& tree) {
  if (serializer.findPointer(const_cast<SphereTree*>(&tree)) != nullptr) return;
  const std::vector<std::byte> bytes = encodeTree(tree);
  writeBytes(serializer, bytes.data(), bytes.size(), kTreeChunk, &tree);
}

// Bullet writes a shape twice under one name if it finds the shape first as a compound's child and then as a body's
// own. Its importer links only the last of the two to its parts. In the first it would follow the file's pointers, so
// that one is emptied.
void emptyEarlier(btSerializer& serializer, const SphereTreeShape& shape) {
  const auto* name = serializer.findPointer(const_cast<SphereTreeShape*>(&shape));
  for (int i = 0; name != nullptr && i < serializer.getNumChunks(); ++i) {
    auto* chunk = const_cast<btChunk*>(serializer.getChunk(i));
    if (chunk->m_chunkCode != BT_SHAPE_CODE || chunk->m_oldPtr != name) continue;
    auto* data = reinterpret_cast<btCompoundShapeData*>(chunk + 1);
    data->m_collisionShapeData.m_name = nullptr;
    data->m_numChildShapes = 0;
  }
}

}  // namespace

int SphereTreeShape::calculateSerializeBufferSize() const {
  return sizeof(btCompoundShapeData);
}

const char* SphereTreeShape::serialize(void* dataBuffer, btSerializer* serializer) const {
  emptyEarlier(*serializer, *this);
  auto* data = new (dataBuffer) btCompoundShapeData{};
  btCollisionShape::serialize(&data->m_collisionShapeData, serializer);
  data->m_collisionShapeData.m_shapeType = COMPOUND_SHAPE_PROXYTYPE;
  const std::vector<NodeId> nodes = tree_->levelCut(compoundLevel_);
  data->m_numChildShapes = static_cast<int>(nodes.size());
  data->m_childShapePtr = writeSpheres(*this, nodes, *serializer);
  writeTree(*serializer, *tree_);
  const void* const record = &tree_;
  if (serializer->findPointer(const_cast<void*>(record)) == nullptr) {
    const TreeShapeRecord values{.frame = static_cast<std::uint32_t>(frame_),
                                 .shapeName = nameInFile(*serializer, this),
                                 .treeName = nameInFile(*serializer, tree_.get()),
                                 .scale = double(scale_),
                                 .margin = double(getMargin())};
    writeBytes(*serializer, &values, sizeof values, kTreeShapeChunk, record);
  }
  return "btCompoundShapeData";
}

}  // namespace cairn::bullet
