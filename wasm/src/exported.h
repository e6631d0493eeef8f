// SPDX-License-Identifier: Zlib
#pragma once

/// A function that JavaScript calls. Natively it is an ordinary one, so that the same calls can be timed there.
#ifdef __EMSCRIPTEN__
#define CAIRN_WASM(type) extern "C" __attribute__((used, visibility("default"))) type
#else
#define CAIRN_WASM(type) extern "C" type
#endif
