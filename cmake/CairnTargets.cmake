# cairn_library(NAME sources...)   a library `cairn_NAME`, alias `cairn::NAME`, built as the project builds everything
# cairn_program(NAME sources...)   a program in bin/
# cairn_check_headers(TARGET dir [WITHOUT headers...])  compiles every public header of a library alone, but for some

add_library(cairn_house INTERFACE)
target_compile_options(cairn_house INTERFACE
  # The same bits for every compiler and instruction set: no fused multiply-add behind our back.
  -ffp-contract=off
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  # GCC 12's superword vectoriser drops the rounding of double -> float -> double pairs (Vec3d(Vec3(v)) keeps the double): a
  # centre would be certified at one place and stored at another. The hot loops are written with Highway and lose nothing.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
  # GCC 12 sees overlaps in std::string's own operator+ (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${CAIRN_WARNINGS_AS_ERRORS}>:-Werror>)

# Standard libraries without algorithms on ranges get those that are used here from a file of ours.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("
  #include <algorithm>
  int main() {
    int numbers[] = {2, 1};
    std::ranges::sort(numbers);
    return numbers[0] - 1;
  }" CAIRN_STD_HAS_RANGES)
if(NOT CAIRN_STD_HAS_RANGES)
  target_compile_options(cairn_house INTERFACE "SHELL:-include ${PROJECT_SOURCE_DIR}/core/src/platform/missing_ranges.h")
endif()

function(cairn_library name)
  add_library(cairn_${name} ${ARGN})
  add_library(cairn::${name} ALIAS cairn_${name})
  set_target_properties(cairn_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(cairn_${name} PRIVATE $<BUILD_INTERFACE:cairn_house>)
  target_compile_features(cairn_${name} PUBLIC cxx_std_20)
endfunction()

# A library that programs link: it shows what its headers mark (`CAIRN_CORE_EXPORT` and the like) and nothing else, and asks
# nobody for run-time type information.
function(cairn_shown_library name)
  set_target_properties(cairn_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(BUILD_SHARED_LIBS)
    target_compile_definitions(cairn_${name} PUBLIC CAIRN_SHARED)
  endif()
  if(NOT CAIRN_RTTI)
    target_compile_options(cairn_${name} PRIVATE $<IF:$<CXX_COMPILER_ID:MSVC>,/GR-,-fno-rtti>)
  endif()
endfunction()

# Where the build is a unity build, sources of one folder are compiled together, so names only have to differ within it.
# Those that include CGAL, whose templates fill a compiler by themselves, and those Highway includes again for every
# instruction set stay alone.
function(cairn_unity_of_rooms target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  # A class of a source that holds one of its unnamed namespace is taken for one of a header.
  target_compile_options(${target} PRIVATE $<$<AND:$<BOOL:${CMAKE_UNITY_BUILD}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} cgal REGEX "^#include (<CGAL/|\"import/from_surface_mesh)")
    file(STRINGS ${source} highway REGEX "^#include <hwy/foreach_target")
    # Of these nearly all code is CGAL's, and checks of undefined behaviour take half the time it compiles; fuzzing has them.
    if(cgal AND CAIRN_SANITIZE MATCHES undefined AND NOT CAIRN_FUZZ)
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -fno-sanitize=undefined)
    endif()
    if(NOT cgal AND NOT highway)
      get_filename_component(folder ${source} DIRECTORY)
      string(REPLACE "${CMAKE_CURRENT_SOURCE_DIR}/" "" folder "${folder}")
      string(MAKE_C_IDENTIFIER "${folder}" group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

function(cairn_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE cairn_house)
  # What takes time is in the libraries: command lines and tests would be compiled twice as long to run no faster.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

function(cairn_check_headers target include_dir)
  if(NOT CAIRN_TESTS OR NOT CAIRN_CHECK_HEADERS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" WITHOUT)
  file(GLOB_RECURSE headers RELATIVE ${include_dir} CONFIGURE_DEPENDS ${include_dir}/*.h)
  if(arg_WITHOUT)
    list(REMOVE_ITEM headers ${arg_WITHOUT})
  endif()
  set(sources)
  foreach(header IN LISTS headers)
    string(MAKE_C_IDENTIFIER ${header} id)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/header_alone/${id}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n#include \"${header}\"\n")
    list(APPEND sources ${source})
  endforeach()
  get_filename_component(folder ${include_dir} NAME)
  set(alone ${target}_${folder}_alone)
  add_library(${alone} OBJECT ${sources})
  set_target_properties(${alone} PROPERTIES UNITY_BUILD OFF)
  target_link_libraries(${alone} PRIVATE ${target} cairn_house)
endfunction()
