// SPDX-License-Identifier: Zlib
// What every public header begins with: the language it needs, and what a shared library shows.
#pragma once

#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 202002L
#error "Cairn needs C++20: compile with -std=c++20 (MSVC: /std:c++20; CMake: the feature cxx_std_20)"
// Ends the compilation here: everything after would be errors about C++20 that say less.
#include <cairn_needs_cxx_20>
#endif

// CAIRN_SHARED: the libraries are shared ones. Everything else of them is hidden; CAIRN_HIDDEN hides a class inside a
// class that is shown.
#ifdef _WIN32
#define CAIRN_HIDDEN
#else
#define CAIRN_HIDDEN __attribute__((visibility("hidden")))
#endif
#if defined(_WIN32) && defined(CAIRN_SHARED)
#define CAIRN_EXPORTED __declspec(dllexport)
#define CAIRN_IMPORTED __declspec(dllimport)
#elif defined(_WIN32)
#define CAIRN_EXPORTED
#define CAIRN_IMPORTED
#else
#define CAIRN_EXPORTED __attribute__((visibility("default")))
#define CAIRN_IMPORTED __attribute__((visibility("default")))
#endif

#if defined(cairn_core_EXPORTS)
#define CAIRN_CORE_EXPORT CAIRN_EXPORTED
#else
#define CAIRN_CORE_EXPORT CAIRN_IMPORTED
#endif
#if defined(cairn_bullet_EXPORTS)
#define CAIRN_BULLET_EXPORT CAIRN_EXPORTED
#else
#define CAIRN_BULLET_EXPORT CAIRN_IMPORTED
#endif
#if defined(cairn_effects_EXPORTS)
#define CAIRN_EFFECTS_EXPORT CAIRN_EXPORTED
#else
#define CAIRN_EFFECTS_EXPORT CAIRN_IMPORTED
#endif
