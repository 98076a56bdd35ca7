# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# qwsm_embed_page(OUTPUT VARIABLE TEMPLATE ... STYLE ... SCRIPTS ...): a source that holds a page of HTML
# as `extern const std::string_view VARIABLE`, its style sheet and scripts, in their order, put in place
# of {{style}} and {{script}}. The page stands in the source tree as files that editors and browsers know.
#
# Run as a script, with -D of what the function passes on, it writes that source.

function(qwsm_embed_page output variable)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "TEMPLATE;STYLE" "SCRIPTS")
  list(JOIN arg_SCRIPTS "|" scripts)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${output} -D VARIABLE=${variable} -D TEMPLATE=${arg_TEMPLATE}
      -D STYLE=${arg_STYLE} -D "SCRIPTS=${scripts}" -P ${PROJECT_SOURCE_DIR}/cmake/QwsmEmbed.cmake
    DEPENDS ${arg_TEMPLATE} ${arg_STYLE} ${arg_SCRIPTS} ${PROJECT_SOURCE_DIR}/cmake/QwsmEmbed.cmake
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    COMMENT "Embedding ${arg_TEMPLATE}" VERBATIM)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

file(READ ${TEMPLATE} page)
file(READ ${STYLE} style)
string(REPLACE "|" ";" files "${SCRIPTS}")
set(script "")
foreach(name IN LISTS files)
  file(READ ${name} part)
  string(APPEND script "${part}")
endforeach()
string(REPLACE "{{style}}" "${style}" page "${page}")
string(REPLACE "{{script}}" "${script}" page "${page}")
string(FIND "${page}" ")page\"" ends_early)
if(NOT ends_early EQUAL -1)
  message(FATAL_ERROR "${TEMPLATE}: the page holds )page\", which ends the literal it is put in")
endif()
file(WRITE ${OUTPUT} "// Made by cmake/QwsmEmbed.cmake of ${TEMPLATE}.
#include <string_view>

namespace qwsm::pipeline {

extern const std::string_view ${VARIABLE};
const std::string_view ${VARIABLE} = R\"page(${page})page\";

}  // namespace qwsm::pipeline
")
