# The same without vectors, for hosts that have none.
set(CAIRN_WASM_VECTORS "")
include(${CMAKE_CURRENT_LIST_DIR}/wasm.cmake)
