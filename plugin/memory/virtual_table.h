// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstring>

namespace cairn::bullet {

/// What an object's class answers its virtual functions with. Programs, Bullet among them, may be compiled without
/// run-time type information (Bullet's own default with MSVC): `dynamic_cast` and `typeid` of their objects are then
/// undefined, but the tables are there.
using VirtualTable = const void* const*;

/// Precondition: an object whose class has virtual functions, the first of its bases too.
inline VirtualTable virtualTableOf(const void* object) {
  VirtualTable table = nullptr;
  std::memcpy(&table, object, sizeof table);
  return table;
}

/// Whether the class of an object was certainly compiled with run-time type information, so that `dynamic_cast` may
/// ask. With the Itanium C++ ABI the entry before the first function tells; elsewhere nobody can know. Precondition: as
/// above.
inline bool hasTypeInfo([[maybe_unused]] const void* object) {
#if defined(__GXX_ABI_VERSION) && !defined(_MSC_VER)
  return virtualTableOf(object)[-1] != nullptr;
#else
  return false;
#endif
}

/// Places the destructor takes at the head of a table whose class declares it first, as Bullet's do.
#if defined(_MSC_VER)
inline constexpr std::size_t kPlacesOfDestructor = 1;
#else
inline constexpr std::size_t kPlacesOfDestructor = 2;
#endif

/// Tells whether objects answer one virtual function as `plain` does. `other` is of a class derived from that of
/// `plain`, which overrides this function and nothing else: where their tables differ is its place. Both are of
/// classes of the file that asks, or they may differ in inline functions of which each library has its own copy. Of an
/// object whose code of this function is another copy of the same it says no.
class KeptFunction {
 public:
  KeptFunction(const void* plain, const void* other) {
    const VirtualTable kept = virtualTableOf(plain), overridden = virtualTableOf(other);
    while (kept[place_] == overridden[place_]) ++place_;
    code_ = kept[place_];
  }
  /// Precondition: of a class derived from the one that declares the function.
  bool isKeptBy(const void* object) const { return virtualTableOf(object)[place_] == code_; }

 private:
  std::size_t place_ = kPlacesOfDestructor;
  const void* code_ = nullptr;
};

}  // namespace cairn::bullet
