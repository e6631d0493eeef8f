# cairn_library(NAME sources...)   a library `cairn_NAME`, alias `cairn::NAME`, built as the house builds everything
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

function(cairn_library name)
  add_library(cairn_${name} ${ARGN})
  add_library(cairn::${name} ALIAS cairn_${name})
  set_target_properties(cairn_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(cairn_${name} PRIVATE $<BUILD_INTERFACE:cairn_house>)
  target_compile_features(cairn_${name} PUBLIC cxx_std_20)
endfunction()

function(cairn_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE cairn_house)
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
  add_library(${target}_headers_alone OBJECT ${sources})
  target_link_libraries(${target}_headers_alone PRIVATE ${target} cairn_house)
endfunction()
