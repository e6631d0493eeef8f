# What every target of the project is compiled with.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT EMSCRIPTEN)  # whose programs are whole; indirections would cost
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
  endif()

  find_program(CAIRN_CCACHE ccache)
  if(CAIRN_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CAIRN_CCACHE})
  endif()
  # mold links the CGAL-heavy programs several times faster; GCC 12 knows it by name.
  find_program(CAIRN_MOLD mold)
  if(CAIRN_MOLD AND NOT CMAKE_CROSSCOMPILING)
    add_link_options(-fuse-ld=mold)
  endif()

  if(CAIRN_SANITIZE)
    # With sanitizers GCC takes empty optionals of libraries for uninitialised ones, as its manual warns.
    add_compile_options(-fsanitize=${CAIRN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
                        $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    add_link_options(-fsanitize=${CAIRN_SANITIZE})
  endif()
  if(CAIRN_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)  # the fuzzer steers by the coverage of the libraries it calls
  endif()
endif()
