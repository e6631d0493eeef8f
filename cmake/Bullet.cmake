# Bullet::Collision and Bullet::Dynamics as imported targets, from existing targets or from an installed Bullet.
#
# Debian's package ships two ABIs side by side (float and -float64) and a BulletConfig.cmake whose paths are relative and
# which defines no targets; it is used for the version and the definitions only. A mismatch between header precision and
# library would corrupt memory at run time, so a symbol whose mangled name contains the scalar type is linked right here.

include(CheckCXXSourceCompiles)

if(TARGET Bullet::Collision AND TARGET Bullet::Dynamics)
  return()
endif()

if(CAIRN_DOUBLE_PRECISION)
  set(cairn_bullet_suffix -float64)
  set(cairn_bullet_config BulletConfig-float64.cmake)
else()
  set(cairn_bullet_suffix "")
  set(cairn_bullet_config BulletConfig.cmake)
endif()

find_package(Bullet CONFIG QUIET CONFIGS ${cairn_bullet_config})
if(NOT Bullet_FOUND)
  message(FATAL_ERROR "Bullet${cairn_bullet_suffix} was not found: install libbullet-dev, or set Bullet_DIR to the folder "
                      "with ${cairn_bullet_config}, or configure with -DCAIRN_PLUGIN=OFF.")
endif()
if(BULLET_VERSION_STRING VERSION_LESS 3.0)
  message(FATAL_ERROR "Bullet ${BULLET_VERSION_STRING} is too old: Cairn needs 3.0 or newer.")
endif()

find_path(CAIRN_BULLET_INCLUDE_DIR btBulletDynamicsCommon.h
          HINTS ${BULLET_ROOT_DIR}/${BULLET_INCLUDE_DIR} PATH_SUFFIXES bullet REQUIRED)
string(REPLACE "-D" "" cairn_bullet_definitions "${BULLET_DEFINITIONS}")
separate_arguments(cairn_bullet_definitions)
if(CAIRN_DOUBLE_PRECISION)
  list(APPEND cairn_bullet_definitions BT_USE_DOUBLE_PRECISION)
  list(REMOVE_DUPLICATES cairn_bullet_definitions)
endif()

foreach(library LinearMath BulletCollision BulletDynamics)
  find_library(CAIRN_${library}${cairn_bullet_suffix} ${library}${cairn_bullet_suffix}
               HINTS ${BULLET_ROOT_DIR}/${BULLET_LIBRARY_DIRS} REQUIRED)
endforeach()

function(cairn_import_bullet target)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  # SYSTEM include order matters little, but Bullet's headers must not be held to our warnings.
  target_include_directories(${target} SYSTEM INTERFACE ${CAIRN_BULLET_INCLUDE_DIR})
  target_compile_definitions(${target} INTERFACE ${cairn_bullet_definitions})
  foreach(library IN LISTS ARGN)
    target_link_libraries(${target} INTERFACE ${CAIRN_${library}${cairn_bullet_suffix}})
  endforeach()
endfunction()
cairn_import_bullet(Bullet::Collision BulletCollision LinearMath)
cairn_import_bullet(Bullet::Dynamics BulletDynamics BulletCollision LinearMath)

set(CMAKE_REQUIRED_LIBRARIES Bullet::Collision)
check_cxx_source_compiles("
  #include <btBulletCollisionCommon.h>
  int main() {
    btSphereShape sphere(1);
    btVector3 center;
    btScalar radius;
    sphere.btCollisionShape::getBoundingSphere(center, radius);
    return radius > 2;
  }" CAIRN_BULLET_PRECISION_MATCHES${cairn_bullet_suffix})
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT CAIRN_BULLET_PRECISION_MATCHES${cairn_bullet_suffix})
  message(FATAL_ERROR "Bullet's library ${CAIRN_BulletCollision${cairn_bullet_suffix}} does not match its headers with "
                      "definitions '${cairn_bullet_definitions}': single and double precision must not be mixed. Set "
                      "CAIRN_DOUBLE_PRECISION to what the library was built with.")
endif()
message(STATUS "Bullet ${BULLET_VERSION_STRING}${cairn_bullet_suffix}: ${CAIRN_BulletCollision${cairn_bullet_suffix}}")
