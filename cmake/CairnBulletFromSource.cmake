# Bullet's collision, dynamics and soft bodies from Debian's source package as static libraries of this project, for tests, with
# the same sanitizers as everything else: with BT_THREADSAFE (the package itself is not thread-safe, its locks do nothing, and
# there is no task scheduler), without run-time type information, as Bullet's own project builds it with MSVC, or for another
# platform. Products and sums are not fused, which ARM's compilers do by default: Debian's library for x86-64 has none.
include(FetchContent)

FetchContent_Declare(bullet_source
  URL https://deb.debian.org/debian/pool/main/b/bullet/bullet_3.24+dfsg.orig.tar.xz
      http://deb.debian.org/debian/pool/main/b/bullet/bullet_3.24+dfsg.orig.tar.xz
  URL_HASH SHA256=43c1edae2024ba18bb5d7bfd3bb2394b066a79151a29789504a2d8efcdc333d7
  DOWNLOAD_EXTRACT_TIMESTAMP TRUE
  SOURCE_SUBDIR does-not-exist)  # the sources alone: Bullet's own project brings demos and Python
FetchContent_MakeAvailable(bullet_source)
find_package(Threads REQUIRED)

function(cairn_bullet_from_source target)
  file(GLOB_RECURSE sources ${bullet_source_SOURCE_DIR}/src/${target}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "Bullet(Collision|Dynamics)/(Bullet|.*/Bullet)")
  add_library(bullet_${target} STATIC ${sources})
  target_include_directories(bullet_${target} SYSTEM PUBLIC ${bullet_source_SOURCE_DIR}/src)
  target_compile_definitions(bullet_${target} PUBLIC $<$<BOOL:${CAIRN_THREAD_SAFE_BULLET}>:BT_THREADSAFE=1>)
  target_compile_options(bullet_${target} PRIVATE -w -ffp-contract=off $<$<BOOL:${CAIRN_BULLET_WITHOUT_RTTI}>:-fno-rtti>)
  target_link_libraries(bullet_${target} PUBLIC Threads::Threads ${ARGN})
endfunction()
cairn_bullet_from_source(LinearMath)
cairn_bullet_from_source(BulletCollision bullet_LinearMath)
cairn_bullet_from_source(BulletDynamics bullet_BulletCollision)
cairn_bullet_from_source(BulletSoftBody bullet_BulletDynamics)
set_target_properties(bullet_BulletSoftBody PROPERTIES UNITY_BUILD OFF)  # some of its headers have no guard
add_library(Bullet::Collision ALIAS bullet_BulletCollision)
add_library(Bullet::Dynamics ALIAS bullet_BulletDynamics)
add_library(Bullet::SoftBody ALIAS bullet_BulletSoftBody)
