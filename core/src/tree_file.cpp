// SPDX-License-Identifier: Zlib
#include "cairn/core/tree_file.h"

#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "cairn/core/state_hash.h"
#include "cairn_tree_generated.h"

namespace cairn {

namespace {

using Bytes = std::span<const std::byte>;

// FlatBuffers refuses buffers of 2 GiB; a file is verified in time linear in its size.
constexpr std::size_t kMaxFile = FLATBUFFERS_MAX_BUFFER_SIZE;
// Bytes 0-3 are the root offset, 4-7 the identifier; nothing shorter can hold a tree.
constexpr std::size_t kMinFile = 16;

file::Vec3f pack(const Vec3& v) {
  return {v.x, v.y, v.z};
}
file::Vec3d pack(const Vec3d& v) {
  return {v.x, v.y, v.z};
}
file::Triangle pack(const std::array<std::uint32_t, 3>& t) {
  return {t[0], t[1], t[2]};
}
Vec3 unpack(const file::Vec3f& v) {
  return {v.x(), v.y(), v.z()};
}
Vec3d unpack(const file::Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

file::Node pack(const NodeData& n) {
  return {pack(n.center),
          n.radius,
          n.error,
          n.innerRadius,
          pack(n.normalCone.axis),
          n.normalCone.cosine,
          n.parent,
          n.firstSupport,
          n.firstNormal,
          n.firstTriangle,
          n.triangleCount,
          static_cast<std::uint16_t>(n.supportCount),
          static_cast<std::uint16_t>(n.normalCount)};
}

NodeData unpack(const file::Node& n) {
  NodeData node;
  node.center = unpack(n.center());
  node.radius = n.radius();
  node.error = n.error();
  node.innerRadius = n.inner_radius();
  node.parent = n.parent();
  node.firstSupport = n.first_support();
  node.supportCount = n.support_count();
  node.firstNormal = n.first_normal();
  node.normalCount = n.normal_count();
  node.firstTriangle = n.first_triangle();
  node.triangleCount = n.triangle_count();
  node.normalCone = {unpack(n.cone_axis()), n.cone_cosine()};
  return node;
}

file::Bound pack(const Sphere& s) {
  return {pack(s.center), s.radius};
}

Sphere unpack(const file::Bound& b) {
  return {unpack(b.center()), b.radius()};
}

std::array<std::uint32_t, 3> unpack(const file::Triangle& t) {
  return {t.a(), t.b(), t.c()};
}

file::Mass pack(const MassProperties& m) {
  file::Mass packed(m.volume, pack(m.centerOfMass), pack(m.principalMoments));
  for (int i = 0; i < 9; ++i) {
    packed.mutable_inertia()->Mutate(i, m.inertia(i / 3, i % 3));
    packed.mutable_principal_axes()->Mutate(i, m.principalAxes(i / 3, i % 3));
  }
  return packed;
}

MassProperties unpack(const file::Mass& m) {
  MassProperties mass;
  mass.volume = m.volume();
  mass.centerOfMass = unpack(m.center_of_mass());
  mass.principalMoments = unpack(m.principal_moments());
  for (int i = 0; i < 9; ++i) {
    mass.inertia(i / 3, i % 3) = m.inertia()->Get(i);
    mass.principalAxes(i / 3, i % 3) = m.principal_axes()->Get(i);
  }
  return mass;
}

template <class Packed, class T>
auto packAll(flatbuffers::FlatBufferBuilder& builder, const std::vector<T>& items) {
  return builder.CreateVectorOfStructs<Packed>(items.size(),
                                               [&](std::size_t i, Packed* out) { *out = pack(items[i]); });
}

template <class T, class Packed>
std::vector<T> unpackAll(const flatbuffers::Vector<const Packed*>& items) {
  std::vector<T> result;
  result.reserve(items.size());
  for (const Packed* item : items) result.push_back(unpack(*item));
  return result;
}

auto packBuild(flatbuffers::FlatBufferBuilder& builder, const BuildInfo& info) {
  const auto name = builder.CreateString(info.meshName);
  const auto sha = builder.CreateString(info.meshSha256);
  const auto method = builder.CreateString(info.method);
  return file::CreateBuild(builder, name, sha, method, info.branching, info.depth, info.samples, info.seed);
}

BuildInfo unpack(const file::Build& b) {
  BuildInfo info;
  const auto text = [](const flatbuffers::String* s) { return s != nullptr ? s->str() : std::string(); };
  info.meshName = text(b.mesh_name());
  info.meshSha256 = text(b.mesh_sha256());
  info.method = text(b.method());
  info.branching = b.branching();
  info.depth = b.depth();
  info.samples = b.samples();
  info.seed = b.seed();
  return info;
}

LevelMesh unpack(const file::LevelMesh& m) {
  return {unpackAll<Vec3>(*m.vertices()), unpackAll<std::array<std::uint32_t, 3>>(*m.triangles()), m.distance()};
}

using LevelMeshes = flatbuffers::Vector<flatbuffers::Offset<file::LevelMesh>>;

// Null, a field that is absent, where there are none.
flatbuffers::Offset<LevelMeshes> packLevelMeshes(flatbuffers::FlatBufferBuilder& builder,
                                                 const std::vector<LevelMesh>& meshes) {
  std::vector<flatbuffers::Offset<file::LevelMesh>> packed;
  for (const LevelMesh& mesh : meshes) {
    const auto vertices = packAll<file::Vec3f>(builder, mesh.vertices);
    const auto triangles = packAll<file::Triangle>(builder, mesh.triangles);
    packed.push_back(file::CreateLevelMesh(builder, vertices, triangles, mesh.distance));
  }
  return packed.empty() ? 0 : builder.CreateVector(packed);
}

SphereTreeData unpack(const file::Tree& t) {
  SphereTreeData data;
  data.origin = unpack(*t.origin());
  data.mass = unpack(*t.mass());
  data.nodes = unpackAll<NodeData>(*t.nodes());
  data.supportPoints = unpackAll<Vec3>(*t.support_points());
  data.faceNormals = unpackAll<Vec3>(*t.face_normals());
  data.regionTriangles.assign(t.region_triangles()->begin(), t.region_triangles()->end());
  data.vertices = unpackAll<Vec3>(*t.vertices());
  data.triangles = unpackAll<std::array<std::uint32_t, 3>>(*t.triangles());
  if (t.level_meshes() != nullptr)
    for (const file::LevelMesh* mesh : *t.level_meshes()) data.levelMeshes.push_back(unpack(*mesh));
  if (t.bounds() != nullptr) data.bounds = unpackAll<Sphere>(*t.bounds());
  data.info = unpack(*t.build());
  return data;
}

// The checksum as it has to be: over all bytes, its own eight taken as zero.
std::optional<std::uint64_t> checksumOf(Bytes bytes) {
  const auto* field = flatbuffers::GetRoot<flatbuffers::Table>(bytes.data())->GetAddressOf(file::Tree::VT_CHECKSUM);
  if (field == nullptr) return std::nullopt;
  StateHash hash;
  const auto at = static_cast<std::size_t>(field - reinterpret_cast<const std::uint8_t*>(bytes.data()));
  constexpr std::byte kZeros[8] = {};
  hash.add(bytes.first(at));
  hash.add(Bytes(kZeros));
  hash.add(bytes.subspan(at + 8));
  return hash.value();
}

// Only the first field of the root table is looked at, which every version of the format has.
std::optional<std::uint32_t> versionOf(const std::uint8_t* bytes, std::size_t size) {
  flatbuffers::Verifier verifier(bytes, size);
  const auto* table = flatbuffers::GetRoot<flatbuffers::Table>(bytes);
  const auto offset = flatbuffers::ReadScalar<flatbuffers::uoffset_t>(bytes);
  if (offset < 8 || offset >= size || !table->VerifyTableStart(verifier)) return std::nullopt;
  if (!table->VerifyField<std::uint32_t>(verifier, file::Tree::VT_VERSION, sizeof(std::uint32_t))) return std::nullopt;
  return table->GetField<std::uint32_t>(file::Tree::VT_VERSION, 0);
}

Error damaged(const char* how) {
  return Error{std::string("is truncated or damaged (") + how + "); build it again with `cairn build`"};
}

Result<SphereTree> decodeAligned(Bytes bytes) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (!file::TreeBufferHasIdentifier(raw)) return Error{"is not a Cairn tree; make one with `cairn build`"};
  const std::optional<std::uint32_t> version = versionOf(raw, bytes.size());
  if (!version) return damaged("no version");
  if (*version != kTreeFileVersion)
    return Error{"has format version " + std::to_string(*version) + ", this program reads version " +
                 std::to_string(kTreeFileVersion) + "; build it again with `cairn build`"};
  flatbuffers::Verifier verifier(raw, bytes.size());
  if (!file::VerifyTreeBuffer(verifier)) return damaged("broken structure");
  const file::Tree& tree = *file::GetTree(raw);
  if (checksumOf(bytes) != tree.checksum()) return damaged("wrong checksum");
  // Tables may share their vectors: a small file could unpack to any number of meshes.
  if (tree.level_meshes() != nullptr && tree.level_meshes()->size() > kMaxDepth)
    return damaged("too many level meshes");
  return SphereTree::create(unpack(tree));
}

}  // namespace

std::vector<std::byte> encodeTree(const SphereTree& tree) {
  const SphereTreeData& data = tree.data();
  flatbuffers::FlatBufferBuilder builder(std::size_t{1} << 16);
  builder.ForceDefaults(true);  // a field left out could not be patched, and absent is not the same as zero to a reader
  const auto nodes = packAll<file::Node>(builder, data.nodes);
  const auto support = packAll<file::Vec3f>(builder, data.supportPoints);
  const auto normals = packAll<file::Vec3f>(builder, data.faceNormals);
  const auto regions = builder.CreateVector(data.regionTriangles);
  const auto vertices = packAll<file::Vec3f>(builder, data.vertices);
  const auto triangles = packAll<file::Triangle>(builder, data.triangles);
  const auto levelMeshes = packLevelMeshes(builder, data.levelMeshes);
  const auto bounds = data.bounds.empty() ? 0 : packAll<file::Bound>(builder, data.bounds);
  const auto build = packBuild(builder, data.info);
  const file::Vec3d origin = pack(data.origin);
  const file::Mass mass = pack(data.mass);
  file::FinishTreeBuffer(builder, file::CreateTree(builder, kTreeFileVersion, 0, &origin, &mass, nodes, support,
                                                   normals, regions, vertices, triangles, build, levelMeshes, bounds));

  std::vector<std::byte> bytes(builder.GetSize());
  std::memcpy(bytes.data(), builder.GetBufferPointer(), bytes.size());
  flatbuffers::GetMutableRoot<file::Tree>(bytes.data())->mutate_checksum(checksumOf(bytes).value());
  return bytes;
}

Result<SphereTree> decodeTree(std::span<const std::byte> bytes) {
  if (bytes.size() < kMinFile) return Error{"is not a Cairn tree (too short); make one with `cairn build`"};
  if (bytes.size() >= kMaxFile) return Error{"is not a Cairn tree (too large); make one with `cairn build`"};
  // FlatBuffers reads in place and needs the alignment that new storage has.
  const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
  return decodeAligned(aligned);
}

namespace {

Result<SphereTree> load(const std::filesystem::path& path) {
  Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes) return bytes.error();
  Result<SphereTree> tree = decodeTree(bytes.value());
  if (!tree) return Error{path.string() + " " + tree.error().message};
  return tree;
}

Status save(const SphereTree& tree, const std::filesystem::path& path) {
  return writeFileAtomically(path, encodeTree(tree));
}

}  // namespace

Result<SphereTree> loadTree(const char* path) {
  return load(path);
}

Status saveTree(const SphereTree& tree, const char* path) {
  return save(tree, path);
}

#ifdef _WIN32
Result<SphereTree> loadTree(const wchar_t* path) {
  return load(path);
}

Status saveTree(const SphereTree& tree, const wchar_t* path) {
  return save(tree, path);
}
#endif

}  // namespace cairn
