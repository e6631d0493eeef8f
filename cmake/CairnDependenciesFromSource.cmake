# hwy::hwy, flatbuffers::flatbuffers and GTest::gtest_main from Debian's sources, as static libraries of this project, for
# platforms that Debian has no packages for. Bullet comes from CairnBulletFromSource. The compiler of the tree's schema,
# flatc, runs on this machine and stays Debian's.
include(FetchContent)

FetchContent_Declare(highway_source
  URL https://deb.debian.org/debian/pool/main/h/highway/highway_1.0.3.orig.tar.gz
      http://deb.debian.org/debian/pool/main/h/highway/highway_1.0.3.orig.tar.gz
  URL_HASH SHA256=566fc77315878473d9a6bd815f7de78c73734acdcb745c3dde8579560ac5440e
  DOWNLOAD_EXTRACT_TIMESTAMP TRUE
  SOURCE_SUBDIR does-not-exist)  # the sources alone: its own project brings tests and what we do not use
FetchContent_Declare(flatbuffers_source
  URL https://deb.debian.org/debian/pool/main/f/flatbuffers/flatbuffers_2.0.8+dfsg1.orig.tar.xz
      http://deb.debian.org/debian/pool/main/f/flatbuffers/flatbuffers_2.0.8+dfsg1.orig.tar.xz
  URL_HASH SHA256=424b8c76568e718a1a05c3fbc6b2070c83b5e55d9b48568fa4f744e9bcd1163a
  DOWNLOAD_EXTRACT_TIMESTAMP TRUE
  SOURCE_SUBDIR does-not-exist)
FetchContent_MakeAvailable(highway_source flatbuffers_source)

add_library(cairn_highway STATIC ${highway_source_SOURCE_DIR}/hwy/aligned_allocator.cc ${highway_source_SOURCE_DIR}/hwy/per_target.cc
            ${highway_source_SOURCE_DIR}/hwy/targets.cc)
target_include_directories(cairn_highway SYSTEM PUBLIC ${highway_source_SOURCE_DIR})
target_compile_definitions(cairn_highway PUBLIC HWY_STATIC_DEFINE)
target_compile_options(cairn_highway PRIVATE -w)
add_library(hwy::hwy ALIAS cairn_highway)

add_library(cairn_flatbuffers INTERFACE)
target_include_directories(cairn_flatbuffers SYSTEM INTERFACE ${flatbuffers_source_SOURCE_DIR}/include)
add_library(flatbuffers::flatbuffers ALIAS cairn_flatbuffers)

if(CAIRN_TESTS)
  set(googletest /usr/src/googletest/googletest)  # Debian's package googletest
  find_package(Threads REQUIRED)
  add_library(cairn_gtest STATIC ${googletest}/src/gtest-all.cc ${googletest}/src/gtest_main.cc)
  target_include_directories(cairn_gtest SYSTEM PUBLIC ${googletest}/include PRIVATE ${googletest})
  target_compile_options(cairn_gtest PRIVATE -w)
  target_link_libraries(cairn_gtest PUBLIC Threads::Threads)
  add_library(GTest::gtest_main ALIAS cairn_gtest)
endif()
