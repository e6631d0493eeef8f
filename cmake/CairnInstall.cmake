# What `cmake --install` and CPack carry: component "plugin" (libraries, headers, CMake and pkg-config files a game needs)
# and component "builder" (the commands `cairn` and `cairn-advise`). The double-precision build has names of its own, so that both can be
# installed side by side, as Bullet's are.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(cairn_suffix "")
set(cairn_headers plugin)
if(CAIRN_DOUBLE_PRECISION)
  set(cairn_suffix -float64)
  set(cairn_headers headers)  # the same files: as Debian packages, one depends on the other
endif()
set(cairn_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cairn${cairn_suffix})

# One library with its public headers.
function(cairn_install_library target include_dir)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${target}${cairn_suffix} VERSION ${PROJECT_VERSION}
                                             SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  install(TARGETS ${target} EXPORT cairn COMPONENT plugin LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY ${include_dir}/cairn DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${cairn_headers})
endfunction()

cairn_install_library(cairn_core ${PROJECT_SOURCE_DIR}/core/include)
cairn_install_library(cairn_bullet ${PROJECT_SOURCE_DIR}/plugin/include)
cairn_install_library(cairn_effects ${PROJECT_SOURCE_DIR}/plugin/effects/include)
set(cairn_soft_package "")
if(TARGET cairn_soft)
  cairn_install_library(cairn_soft ${PROJECT_SOURCE_DIR}/plugin/soft/include)
  set(cairn_soft_package cairn-soft)
endif()
cairn_install_library(cairn_c ${PROJECT_SOURCE_DIR}/plugin/c/include)
install(EXPORT cairn NAMESPACE cairn:: FILE cairnTargets.cmake DESTINATION ${cairn_package_dir} COMPONENT plugin)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/install/cairnConfig.cmake.in cairn${cairn_suffix}Config.cmake
                              INSTALL_DESTINATION ${cairn_package_dir})
write_basic_package_version_file(cairn${cairn_suffix}ConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/cairn${cairn_suffix}Config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/cairn${cairn_suffix}ConfigVersion.cmake ${CMAKE_CURRENT_LIST_DIR}/CairnBullet.cmake
        DESTINATION ${cairn_package_dir} COMPONENT plugin)

set(cairn_pc_definitions "")
if(BUILD_SHARED_LIBS)
  set(cairn_pc_definitions " -DCAIRN_SHARED")
  set(cairn_pc_runtime "")
else()
  set(cairn_pc_runtime " -lstdc++ -lm")  # a C compiler does not link them by itself
endif()
file(RELATIVE_PATH cairn_prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
foreach(package cairn cairn-effects cairn-c ${cairn_soft_package})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/install/${package}.pc.in ${package}${cairn_suffix}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${package}${cairn_suffix}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT plugin)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/plugin/LICENSE RENAME copyright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libcairn${cairn_suffix}-dev COMPONENT plugin)

if(CAIRN_BUILDER)
  install(TARGETS cairn RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT builder)
  if(TARGET cairn-advise)  # what `cairn advise` starts
    install(TARGETS cairn-advise RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT builder)
  endif()
  if(BUILD_SHARED_LIBS)
    install(TARGETS cairn_builder LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT builder)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/builder/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/cairn-tools
          COMPONENT builder RENAME copyright)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Cairn)
set(CPACK_PACKAGE_CONTACT "The authors of Cairn")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL plugin)
if(CAIRN_BUILDER)
  list(APPEND CPACK_COMPONENTS_ALL builder)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_NAME libcairn${cairn_suffix}-dev)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS "libbullet-dev (>= 3.0), libhwy-dev")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_SUGGESTS "libbullet-extras-dev")  # for cairn/bullet/world_importer.h
if(CAIRN_DOUBLE_PRECISION)
  string(APPEND CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS ", libcairn-dev (= ${PROJECT_VERSION})")
endif()
set(CPACK_DEBIAN_PLUGIN_DESCRIPTION "collision detection that keeps its deadline: sphere-trees for Bullet
 Libraries and headers of the sphere-tree shape and its interruptible narrow phase, for games and simulations that use
 Bullet Physics.")
set(CPACK_DEBIAN_BUILDER_PACKAGE_NAME cairn-tools)
set(CPACK_DEBIAN_BUILDER_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_BUILDER_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_BUILDER_DESCRIPTION "builds certified sphere-trees from triangle meshes
 The command cairn: builds, certifies, evaluates and exports the sphere-trees that libcairn collides, and advises which to use.")
include(CPack)
