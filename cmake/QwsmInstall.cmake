# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# qwsm_install_library(TARGET DESCRIPTION "..." REQUIRES ...): installs a library with the headers of
# its file set, exports it for find_package(qwsm) as qwsm::TARGET, and writes TARGET.pc.
# Every path in what is installed is relative to its own place, so the tree may be moved.

include(CMakePackageConfigHelpers)

set(QWSM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/qwsm)

function(qwsm_install_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DESCRIPTION;REQUIRES" "")
  install(TARGETS ${target} EXPORT qwsmTargets COMPONENT libqwsm-dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

  file(RELATIVE_PATH prefix_from_pc
    /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
  set(name ${target})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/library.pc.in ${target}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}.pc COMPONENT libqwsm-dev
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# qwsm_install_package(): the files find_package(qwsm) reads. Call it once, after the libraries.
function(qwsm_install_package)
  install(EXPORT qwsmTargets NAMESPACE qwsm:: DESTINATION ${QWSM_CMAKE_DIR} COMPONENT libqwsm-dev)
  configure_package_config_file(cmake/qwsmConfig.cmake.in ${PROJECT_BINARY_DIR}/qwsmConfig.cmake
    INSTALL_DESTINATION ${QWSM_CMAKE_DIR})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/qwsmConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES
    ${PROJECT_BINARY_DIR}/qwsmConfig.cmake
    ${PROJECT_BINARY_DIR}/qwsmConfigVersion.cmake
    COMPONENT libqwsm-dev DESTINATION ${QWSM_CMAKE_DIR})
endfunction()
