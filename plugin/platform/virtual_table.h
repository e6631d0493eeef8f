// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstring>

namespace cairn::bullet {

/// The table of an object's virtual functions. Programs, Bullet among them, may be compiled without run-time type
/// information, as Bullet is by default with MSVC. Then `dynamic_cast` and `typeid` of their objects are undefined, but
/// the tables exist.
using VirtualTable = const void* const*;

/// The table of an object. Precondition: its class and the first base of its class have virtual functions.
inline VirtualTable virtualTableOf(const void* object) {
  VirtualTable table = nullptr;
  std::memcpy(&table, object, sizeof table);
  return table;
}

/// Whether an object's class was certainly compiled with run-time type information, so that `dynamic_cast` is allowed.
/// In the Itanium C++ ABI the entry before the first function shows it; elsewhere the answer is no. Precondition: as
/// for `virtualTableOf`.
inline bool hasTypeInfo([[maybe_unused]] const void* object) {
#if defined(__GXX_ABI_VERSION) && !defined(_MSC_VER)
  return virtualTableOf(object)[-1] != nullptr;
#else
  return false;
#endif
}

/// Number of entries of the destructor, which stands first in the tables of Bullet's classes.
#if defined(_MSC_VER)
inline constexpr std::size_t kPlacesOfDestructor = 1;
#else
inline constexpr std::size_t kPlacesOfDestructor = 2;
#endif

/// Recognises objects that do not override one virtual function of a class. `other` is of a class derived from that of
/// `plain` that overrides this function alone, so their tables differ at its entry. Both classes must be defined in the
/// file that asks, because each library has its own copy of inline functions. An object with another copy of the same
/// function is not recognised.
class KeptFunction {
 public:
  KeptFunction(const void* plain, const void* other) {
    const VirtualTable kept = virtualTableOf(plain), overridden = virtualTableOf(other);
    while (kept[place_] == overridden[place_]) ++place_;
    code_ = kept[place_];
  }
  /// Whether `object` keeps the function. Precondition: its class derives from the one that declares the function.
  bool isKeptBy(const void* object) const { return virtualTableOf(object)[place_] == code_; }

 private:
  std::size_t place_ = kPlacesOfDestructor;
  const void* code_ = nullptr;
};

/// The object as a `Class`, or null. Type information decides where there is some. An object without is taken for one
/// if `isRecognised(object)`, for instance by a `KeptFunction`.
template <class Class, class Base, class IsRecognised>
Class* castTo(Base& object, [[maybe_unused]] const IsRecognised& isRecognised) {
#if defined(__cpp_rtti)
  if (hasTypeInfo(&object)) return dynamic_cast<Class*>(&object);
#endif
  return isRecognised(object) ? static_cast<Class*>(&object) : nullptr;
}

}  // namespace cairn::bullet
