# An overlay port that builds this checkout:
#   vcpkg install cairn --overlay-ports=packaging/vcpkg
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES double-precision CAIRN_DOUBLE_PRECISION)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DCAIRN_BUILDER=OFF -DCAIRN_DEMOS=OFF -DCAIRN_TESTS=OFF -DCAIRN_PYTHON=OFF
          "-DCAIRN_FLATC=${CURRENT_HOST_INSTALLED_DIR}/tools/flatbuffers/flatc${VCPKG_HOST_EXECUTABLE_SUFFIX}")
vcpkg_cmake_install()
set(package cairn)
if("double-precision" IN_LIST FEATURES)
  set(package cairn-float64)
endif()
vcpkg_cmake_config_fixup(PACKAGE_NAME ${package} CONFIG_PATH lib/cmake/${package})
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/plugin/LICENSE")
