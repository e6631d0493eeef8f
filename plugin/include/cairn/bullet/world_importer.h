// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletFileLoader/btBulletFile.h>
#include <BulletWorldImporter/btBulletWorldImporter.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cairn/bullet/stored_shapes.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/export.h"

namespace cairn::bullet {

/// Loads `.bullet` files as Bullet's importer does, and restores each `SphereTreeShape` saved in them, also as a child
/// of a compound. Restored are its tree, frame, scale, margin and name, and its bodies with their masses. Shapes that
/// shared a tree share it again.
///
///     cairn::bullet::WorldImporter importer(&world);
///     if (Status status = importer.loadFile("heap.bullet"); !status) return fail(status.error().message);
///     importer.deleteAllData();  // at the end
///
/// As in Bullet's importer, velocities, damping, sleeping and kinematic flags are not restored. Loaded objects belong
/// to the importer and live until `deleteAllData`, which you must call.
///
/// The class exists only in this header, so that Cairn's library does not need Bullet's extras. Link
/// BulletWorldImporter and BulletFileLoader (Debian's libbullet-extras-dev); the CMake target is
/// `Bullet::WorldImporter`.
class WorldImporter : public btBulletWorldImporter {
 public:
  /// Adds bodies to `world` as they are loaded. With null, only the importer holds them.
  explicit WorldImporter(btDynamicsWorld* world = nullptr) : btBulletWorldImporter(world) {}

  /// Fails before anything is loaded when the file cannot be read, is cut short, has the other byte order, or holds a
  /// damaged tree. The error names the file. Bullet alone checks its own chunks, and it trusts them: load files from
  /// strangers at your own risk.
  Status loadFile(const std::filesystem::path& path) {
    Result<std::vector<std::byte>> bytes = readFile(path);
    if (!bytes) return bytes.error();
    Status status = loadFileFromMemory(bytes.value());
    if (!status) return Error{path.string() + " " + status.error().message};
    return status;
  }

  /// Loads a file's bytes, which Bullet may change. Fails as `loadFile`; the error does not name the file.
  Status loadFileFromMemory(std::span<std::byte> bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      return Error{"is larger than the 2 GiB Bullet reads; save its bodies in several files"};
    if (Status status = prepare(bytes); !status) return status;
    const bool loaded = btBulletWorldImporter::loadFileFromMemory(reinterpret_cast<char*>(bytes.data()),
                                                                  static_cast<int>(bytes.size()));
    loading_ = Loading();
    if (!loaded) return Error{"cannot be read by Bullet's importer; write it again"};
    return {};
  }

  /// Bullet calls this while it loads; see `loadFile`.
  btCompoundShape* createCompoundShape() override {
    btCompoundShape* compound = btBulletWorldImporter::createCompoundShape();
    if (loading_.nextCompound < loading_.compounds.size()) {
      const auto own = loading_.treeShapes.find(loading_.compounds[loading_.nextCompound++]);
      if (own != loading_.treeShapes.end()) loading_.standIns.emplace(compound, own->second);
    }
    return compound;
  }

  /// Bullet calls this while it loads; see `loadFile`.
  btRigidBody* createRigidBody(bool isDynamic, btScalar mass, const btTransform& startTransform,
                               btCollisionShape* shape, const char* bodyName) override {
    exchangeChildren();
    const auto own = loading_.standIns.find(shape);
    return btBulletWorldImporter::createRigidBody(isDynamic, mass, startTransform,
                                                  own == loading_.standIns.end() ? shape : own->second, bodyName);
  }

  /// Bullet calls this while it loads; see `loadFile`. False for a file whose shapes are not those it announced.
  bool convertAllObjects(bParse::btBulletFile* file) override {
    if (!claimShapes(*file)) return false;
    const bool converted = btBulletWorldImporter::convertAllObjects(file);
    exchangeChildren();
    keepShapes();
    return converted;
  }

 private:
  // State while a file is loaded. Bullet makes its compounds in a known order, without saying which one it makes. An
  // empty compound is the placeholder of each sphere-tree, until bodies and compounds get the tree itself. Bullet must
  // see the compound when it decides on a body's mass: it sets the mass of every body with a concave shape to 0.
  struct Loading {
    std::vector<StoredShape> stored;
    std::vector<std::unique_ptr<SphereTreeShape>> shapes;  // one for each of `stored`
    std::map<const btCollisionShapeData*, SphereTreeShape*> treeShapes;
    std::vector<const btCollisionShapeData*> compounds;  // in the order Bullet makes them
    std::size_t nextCompound = 0;
    std::map<const btCollisionShape*, SphereTreeShape*> standIns;
    bool areChildrenExchanged = false;
  };

  Status prepare(std::span<const std::byte> bytes) {
    loading_ = Loading();
    Result<std::vector<StoredShape>> stored = readStoredShapes(bytes);
    if (!stored) return stored.error();
    for (const StoredShape& s : stored.value()) {
      auto shape = SphereTreeShape::create(s.tree, s.frame, btScalar(s.scale));
      if (!shape) return Error{"holds a shape that cannot be: " + shape.error().message};
      shape.value()->setMargin(btScalar(s.margin));
      loading_.shapes.push_back(std::move(shape).value());
    }
    loading_.stored = std::move(stored).value();
    return {};
  }

  // Finds the compounds that Bullet read for our shapes and removes their spheres.
  bool claimShapes(bParse::btBulletFile& file) {
    for (std::size_t i = 0; i < loading_.stored.size(); ++i)
      for (const std::size_t chunk : loading_.stored[i].chunks) {
        if (chunk >= static_cast<std::size_t>(file.m_collisionShapes.size())) return false;
        auto* data = reinterpret_cast<btCollisionShapeData*>(file.m_collisionShapes[static_cast<int>(chunk)]);
        if (data->m_shapeType != COMPOUND_SHAPE_PROXYTYPE) return false;
        reinterpret_cast<btCompoundShapeData*>(data)->m_numChildShapes = 0;
        loading_.treeShapes.emplace(data, loading_.shapes[i].get());
      }
    if (loading_.treeShapes.empty()) return true;
    for (int i = 0; i < file.m_collisionShapes.size(); ++i)
      listCompounds(reinterpret_cast<const btCollisionShapeData*>(file.m_collisionShapes[i]));
    return true;
  }

  void listCompounds(const btCollisionShapeData* data) {
    if (data->m_shapeType != COMPOUND_SHAPE_PROXYTYPE) return;
    loading_.compounds.push_back(data);
    const auto* compound = reinterpret_cast<const btCompoundShapeData*>(data);
    for (int i = 0; i < compound->m_numChildShapes; ++i) listCompounds(compound->m_childShapePtr[i].m_childShape);
  }

  // Runs before any body asks a compound for its inertia. Backwards, because Bullet makes a compound before its
  // children, and its box depends on theirs.
  void exchangeChildren() {
    if (std::exchange(loading_.areChildrenExchanged, true) || loading_.standIns.empty()) return;
    for (int i = m_allocatedCollisionShapes.size() - 1; i >= 0; --i)
      if (m_allocatedCollisionShapes[i]->isCompound())
        exchangeChildrenOf(static_cast<btCompoundShape&>(*m_allocatedCollisionShapes[i]));
  }

  void exchangeChildrenOf(btCompoundShape& compound) {
    for (int k = 0; k < compound.getNumChildShapes(); ++k) {
      btCompoundShapeChild& child = compound.getChildList()[k];
      const auto own = loading_.standIns.find(child.m_childShape);
      if (own != loading_.standIns.end()) {
        child.m_childShape = own->second;
        child.m_childShapeType = own->second->getShapeType();
        child.m_childMargin = own->second->getMargin();
      }
      compound.updateChildTransform(k, child.m_transform, false);
    }
    compound.recalculateLocalAabb();
  }

  // Gives the trees the places, names and owner of their placeholders.
  void keepShapes() {
    m_shapeMap.clear();
    for (const auto& [standIn, shape] : loading_.standIns) {
      if (const char** found = m_objectNameMap.find(standIn)) {
        const char* const name = *found;
        m_nameShapeMap.insert(name, shape);
        m_objectNameMap.remove(standIn);
        m_objectNameMap.insert(shape, name);
      }
      m_allocatedCollisionShapes.remove(const_cast<btCollisionShape*>(standIn));
      delete standIn;
    }
    for (std::unique_ptr<SphereTreeShape>& shape : loading_.shapes)
      m_allocatedCollisionShapes.push_back(shape.release());
  }

  Loading loading_;
};

}  // namespace cairn::bullet
