# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Targets `format` (rewrites every tracked source by .clang-format) and `format-check` (fails where
# that would change one).
find_program(QWSM_CLANG_FORMAT NAMES clang-format-14 clang-format)
mark_as_advanced(QWSM_CLANG_FORMAT)

if(QWSM_CLANG_FORMAT)
  set(list_sources "git ls-files -z -- '*.cpp' '*.hpp'")
  add_custom_target(format
    COMMAND sh -c "${list_sources} | xargs -0 '${QWSM_CLANG_FORMAT}' -i"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
  add_custom_target(format-check
    COMMAND sh -c "${list_sources} | xargs -0 '${QWSM_CLANG_FORMAT}' --dry-run --Werror"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()
