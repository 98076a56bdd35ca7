# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# qwsm_version_source(TEMPLATE OUTPUT): OUTPUT is TEMPLATE with @QWSM_VERSION@ replaced by the release
# and the commit, looked up at every build; it is touched only when they change.
set(QWSM_VERSION_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(qwsm_version_source template output)
  add_custom_target(qwsm_version
    COMMAND ${CMAKE_COMMAND} -D TEMPLATE=${template} -D OUTPUT=${output}
      -D RELEASE=${PROJECT_VERSION} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -P ${QWSM_VERSION_SCRIPT}
    BYPRODUCTS ${output}
    COMMENT "Looking up the commit")
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  execute_process(COMMAND git describe --always --dirty --exclude=*
    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  set(QWSM_VERSION ${RELEASE})
  if(commit)
    string(APPEND QWSM_VERSION " (${commit})")
  endif()
  configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
endif()
