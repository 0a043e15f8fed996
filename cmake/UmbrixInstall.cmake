# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where: the tracer (component umbrix_core), umbrix::io (umbrix_io) and the
# programs (umbrix_apps). Each library has an export set of its own, so that a user of the tracer never
# looks for what umbrix::io needs.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/umbrix)
set(generated_dir ${PROJECT_BINARY_DIR}/package)

# Installs a library and its export set under umbrix:: as umbrix-<component>-targets.cmake.
function(umbrix_install_library target component)
  install(TARGETS ${target} EXPORT umbrix-${component}-targets
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT umbrix_${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT umbrix_${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT umbrix_${component})
  install(EXPORT umbrix-${component}-targets NAMESPACE umbrix:: DESTINATION ${package_dir}
    COMPONENT umbrix_${component})
endfunction()

umbrix_install_library(umbrix core)
install(DIRECTORY include/umbrix DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT umbrix_core
  FILES_MATCHING PATTERN "*.h" PATTERN io EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT umbrix_core)

if(UMBRIX_IO)
  umbrix_install_library(umbrix_io io)
  install(DIRECTORY include/umbrix/io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/umbrix COMPONENT umbrix_io)
endif()

foreach(program umbrix_cli umbrix_bench)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT umbrix_apps)
  endif()
endforeach()

if(TARGET umbrix_cli)
  install(DIRECTORY apps/umbrix/openjd apps/umbrix/slurm DESTINATION ${CMAKE_INSTALL_DATADIR}/umbrix
    USE_SOURCE_PERMISSIONS COMPONENT umbrix_apps)
endif()

# The package: a minor version may change the interface while the major one is 0.
get_target_property(umbrix_type umbrix TYPE)
string(COMPARE EQUAL ${umbrix_type} STATIC_LIBRARY umbrix_is_static)
get_property(umbrix_readers GLOBAL PROPERTY UMBRIX_READERS)
string(REPLACE ";" " " umbrix_readers "${umbrix_readers}")
configure_package_config_file(cmake/umbrix-config.cmake.in ${generated_dir}/umbrix-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${generated_dir}/umbrix-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${generated_dir}/umbrix-config.cmake ${generated_dir}/umbrix-config-version.cmake
  DESTINATION ${package_dir} COMPONENT umbrix_core)

# pkg-config: paths relative to the .pc file, so that an installed tree may be moved.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(pc_libdir "\${prefix}")
cmake_path(APPEND pc_libdir ${CMAKE_INSTALL_LIBDIR})
set(pc_includedir "\${prefix}")
cmake_path(APPEND pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})
set(pc_requires_private "")
if(umbrix_is_static)
  set(pc_requires_private "tbb libhwy")
endif()
configure_file(cmake/umbrix.pc.in ${generated_dir}/umbrix.pc @ONLY)
install(FILES ${generated_dir}/umbrix.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT umbrix_core)
