# Bullet::Collision and Bullet::Dynamics as imported targets, from existing targets or from an installed Bullet, and
# Bullet::WorldImporter where Bullet's extras are installed: only who loads .bullet files needs it.
#
# Debian's package ships two ABIs side by side (float and -float64) and a BulletConfig.cmake whose paths are relative and
# which defines no targets; it is used for the version and the definitions only. A mismatch between the precision of
# headers, library and Cairn would corrupt memory at run time, so targets that exist are checked like those made here.

include(CheckCXXSourceCompiles)

if(CAIRN_DOUBLE_PRECISION)
  set(cairn_bullet_suffix -float64)
  set(cairn_bullet_config BulletConfig-float64.cmake)
else()
  set(cairn_bullet_suffix "")
  set(cairn_bullet_config BulletConfig.cmake)
endif()

set(cairn_precision_advice "Single and double precision must not be mixed: set CAIRN_DOUBLE_PRECISION (installed: take \
the package cairn or cairn-float64) to what Bullet was built with, and let the targets carry BT_USE_DOUBLE_PRECISION if \
that is double.")

# What headers with a target's definitions make of btScalar, and a symbol of its library whose mangled name contains it.
# Asked again after every refusal: the answer may be another once the target has been mended.
function(cairn_check_bullet_precision target)
  set(CMAKE_REQUIRED_LIBRARIES ${target})
  if(CAIRN_DOUBLE_PRECISION)
    set(size sizeof\(double\))
  else()
    set(size sizeof\(float\))
  endif()
  check_cxx_source_compiles("
    #include <btBulletCollisionCommon.h>
    static_assert(sizeof(btScalar) == ${size});
    int main() {
      btSphereShape sphere(1);
      btVector3 center;
      btScalar radius;
      sphere.btCollisionShape::getBoundingSphere(center, radius);
      return radius > 2;
    }" CAIRN_BULLET_PRECISION_MATCHES${cairn_bullet_suffix})
  if(NOT CAIRN_BULLET_PRECISION_MATCHES${cairn_bullet_suffix})
    unset(CAIRN_BULLET_PRECISION_MATCHES${cairn_bullet_suffix} CACHE)
    message(FATAL_ERROR "${target} does not serve Cairn${cairn_bullet_suffix}: headers and library of one precision did "
                        "not compile and link. ${cairn_precision_advice}")
  endif()
endfunction()

# A Bullet built by this very project cannot be linked yet: its definitions have to tell. They must be double for its own
# sources and for who links it, or for neither.
function(cairn_check_bullet_definitions target)
  get_target_property(type ${target} TYPE)
  get_target_property(own ${target} COMPILE_DEFINITIONS)
  get_target_property(passed_on ${target} INTERFACE_COMPILE_DEFINITIONS)
  get_directory_property(of_cairn COMPILE_DEFINITIONS)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(own ${passed_on})
  endif()
  list(APPEND own ${CMAKE_CXX_FLAGS})
  list(APPEND passed_on ${of_cairn} ${CMAKE_CXX_FLAGS})
  foreach(definitions own passed_on)
    if("${${definitions}}" MATCHES "BT_USE_DOUBLE_PRECISION")
      set(double TRUE)
    else()
      set(double FALSE)
    endif()
    if((double AND NOT CAIRN_DOUBLE_PRECISION) OR (CAIRN_DOUBLE_PRECISION AND NOT double))
      message(FATAL_ERROR "${target} does not serve Cairn${cairn_bullet_suffix}: by its definitions, it and what links it "
                          "are not of that precision. ${cairn_precision_advice}")
    endif()
  endforeach()
endfunction()

# Headers older than 3.0 lack what Cairn calls. Where a target's folders cannot be read yet, nothing is known and nothing said.
function(cairn_check_bullet_version target)
  get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
  string(REGEX REPLACE "\\$<[A-Z_]+:([^>]*)>" "\\1" folders "${folders}")
  foreach(folder IN LISTS folders)
    if(EXISTS ${folder}/LinearMath/btScalar.h)
      file(STRINGS ${folder}/LinearMath/btScalar.h line REGEX "#define BT_BULLET_VERSION [0-9]+")
      string(REGEX MATCH "[0-9]+$" version "${line}")
      if(version AND version LESS 300)
        message(FATAL_ERROR "Bullet ${version} (${folder}) is too old: Cairn needs 3.0 or newer.")
      endif()
      return()
    endif()
  endforeach()
endfunction()

# Bullet's own project, added to this one, calls its libraries by these names and says of them neither where their headers
# are nor, to others, with which definitions they are compiled.
function(cairn_take_bullets_own_targets)
  get_target_property(source LinearMath SOURCE_DIR)
  get_target_property(definitions LinearMath COMPILE_DEFINITIONS)
  list(FILTER definitions INCLUDE REGEX "^BT_(USE_DOUBLE_PRECISION|THREADSAFE)")
  foreach(name Collision Dynamics)
    add_library(cairn_own_bullet_${name} INTERFACE)
    add_library(Bullet::${name} ALIAS cairn_own_bullet_${name})
    target_include_directories(cairn_own_bullet_${name} SYSTEM INTERFACE ${source}/..)
    target_compile_definitions(cairn_own_bullet_${name} INTERFACE ${definitions})
    target_link_libraries(cairn_own_bullet_${name} INTERFACE Bullet${name} BulletCollision LinearMath)
  endforeach()
endfunction()

# Whether a class derived from one of Bullet's can have run-time type information: not where Bullet was built without. Cairn,
# which does not use it, is then built without as well. With MSVC the two go together.
function(cairn_follow_bullets_rtti target)
  if(MSVC OR NOT CAIRN_RTTI)
    return()
  endif()
  set(CMAKE_REQUIRED_LIBRARIES ${target})
  check_cxx_source_compiles("
    #include <btBulletCollisionCommon.h>
    struct Own : btCollisionDispatcher { using btCollisionDispatcher::btCollisionDispatcher; };
    int main() {
      btDefaultCollisionConfiguration configuration;
      Own own(&configuration);
      return own.getNumManifolds();
    }" CAIRN_BULLET_HAS_RTTI${cairn_bullet_suffix})
  if(NOT CAIRN_BULLET_HAS_RTTI${cairn_bullet_suffix})
    unset(CAIRN_BULLET_HAS_RTTI${cairn_bullet_suffix} CACHE)
    message(STATUS "Bullet was built without run-time type information: so is Cairn")
    set(CAIRN_RTTI OFF PARENT_SCOPE)
  endif()
endfunction()

# Whether all a target stands for exists already.
function(cairn_is_imported target result)
  get_target_property(imported ${target} IMPORTED)
  get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
  foreach(library IN LISTS libraries)
    if(imported AND TARGET ${library})
      cairn_is_imported(${library} imported)
    endif()
  endforeach()
  set(${result} ${imported} PARENT_SCOPE)
endfunction()

if(NOT TARGET Bullet::Collision AND TARGET BulletCollision AND TARGET BulletDynamics AND TARGET LinearMath)
  cairn_take_bullets_own_targets()
endif()
if(TARGET Bullet::Collision AND TARGET Bullet::Dynamics)
  cairn_check_bullet_version(Bullet::Collision)
  cairn_is_imported(Bullet::Collision cairn_bullet_exists)
  if(cairn_bullet_exists)
    unset(CAIRN_BULLET_PRECISION_MATCHES${cairn_bullet_suffix} CACHE)  # another target than last time, perhaps
    cairn_check_bullet_precision(Bullet::Collision)
    cairn_follow_bullets_rtti(Bullet::Collision)
  else()
    cairn_check_bullet_definitions(Bullet::Collision)
  endif()
  return()
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
cairn_check_bullet_precision(Bullet::Collision)
cairn_follow_bullets_rtti(Bullet::Collision)
message(STATUS "Bullet ${BULLET_VERSION_STRING}${cairn_bullet_suffix}: ${CAIRN_BulletCollision${cairn_bullet_suffix}}")

foreach(library BulletWorldImporter BulletFileLoader BulletSoftBody)
  find_library(CAIRN_${library}${cairn_bullet_suffix} ${library}${cairn_bullet_suffix}
               HINTS ${BULLET_ROOT_DIR}/${BULLET_LIBRARY_DIRS})
endforeach()
if(CAIRN_BulletWorldImporter${cairn_bullet_suffix} AND CAIRN_BulletFileLoader${cairn_bullet_suffix} AND
   EXISTS ${CAIRN_BULLET_INCLUDE_DIR}/BulletWorldImporter/btBulletWorldImporter.h)
  cairn_import_bullet(Bullet::WorldImporter BulletWorldImporter BulletFileLoader BulletDynamics BulletCollision LinearMath)
endif()
if(CAIRN_BulletSoftBody${cairn_bullet_suffix} AND EXISTS ${CAIRN_BULLET_INCLUDE_DIR}/BulletSoftBody/btSoftBody.h)
  cairn_import_bullet(Bullet::SoftBody BulletSoftBody BulletDynamics BulletCollision LinearMath)
endif()
