# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# What find_package(qwsm) and pkg-config find of an installation. Every path in what is installed is
# relative to its own place, so the tree may be moved.

include(CMakePackageConfigHelpers)

set(QWSM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/qwsm)

# qwsm_install_library(TARGET [WITH ARCHIVE ...] DESCRIPTION "..." REQUIRES "..."): installs a library
# that is always there, and archives that it is linked with, with the headers of their file sets,
# exports it as qwsm::TARGET, and writes TARGET.pc.
function(qwsm_install_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DESCRIPTION;REQUIRES" "WITH")
  qwsm_install_archives(qwsmTargets ${target} ${arg_WITH})
  list(TRANSFORM arg_WITH PREPEND " -l" OUTPUT_VARIABLE archives)
  string(CONCAT libs "-l${target}" ${archives})
  qwsm_install_pc(${target} "${arg_DESCRIPTION}" "${arg_REQUIRES}" "${libs}")
endfunction()

# qwsm_install_component(NAME TARGETS ... DESCRIPTION "..." PACKAGES "..." ... REQUIRES "..."
#   LIBS "..."): installs a library with dependencies of its own, which a project asks for by
# find_package(qwsm COMPONENTS NAME) and gets as qwsm::NAME, and writes qwsm_NAME.pc.
#
# The first of TARGETS is the library, the others are archives that it is linked with. PACKAGES are
# the arguments of a find_package() each, REQUIRES and LIBS what pkg-config says of the same.
function(qwsm_install_component component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DESCRIPTION;REQUIRES;LIBS" "TARGETS;PACKAGES")
  qwsm_install_archives(qwsm-${component}-targets ${arg_TARGETS})
  install(EXPORT qwsm-${component}-targets NAMESPACE qwsm:: DESTINATION ${QWSM_CMAKE_DIR}
    COMPONENT libqwsm-dev)
  list(JOIN arg_PACKAGES "\"\n  \"" packages)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/component.cmake.in qwsm-${component}.cmake @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/qwsm-${component}.cmake
    COMPONENT libqwsm-dev DESTINATION ${QWSM_CMAKE_DIR})
  qwsm_install_pc(qwsm_${component} "${arg_DESCRIPTION}" "${arg_REQUIRES}" "${arg_LIBS}")
endfunction()

function(qwsm_install_archives export)
  install(TARGETS ${ARGN} EXPORT ${export} COMPONENT libqwsm-dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

function(qwsm_install_pc name description requires libs)
  file(RELATIVE_PATH prefix_from_pc
    /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/library.pc.in ${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc COMPONENT libqwsm-dev
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# qwsm_install_package(): the files find_package(qwsm) reads. Call it once, after the libraries that
# are always there.
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
