# WebAssembly by Debian's Emscripten, run by Node: one thread, vectors of 128 bits, WebAssembly's own exceptions. All
# browsers of 2022 and later have these.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
if(NOT DEFINED CAIRN_WASM_VECTORS)
  set(CAIRN_WASM_VECTORS -msimd128)
endif()
set(CMAKE_CXX_FLAGS_INIT "${CAIRN_WASM_VECTORS} -fwasm-exceptions")
# For programs under Node, linked fast: they see its files, take the memory they need, and return from main.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-O1 -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sEXIT_RUNTIME=1 -sTOTAL_STACK=1MB")
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)  # which this Emscripten takes for a browser's
