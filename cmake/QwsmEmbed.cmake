# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# qwsm_embed_files(OUTPUT FOLDER FILE ...): a source with the contents of text files as string literals, a
# line `QWSM_FILE("/name", R"...")` for each, in their order, to be included where QWSM_FILE is defined.
# Pages stand in the source tree as files that editors and browsers know, and are a part of the program.
#
# Run as a script, with -D of what the function passes on, it writes that source.

function(qwsm_embed_files output folder)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE paths)
  list(JOIN ARGN "|" files)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${output} -D FOLDER=${folder} -D "FILES=${files}"
      -P ${PROJECT_SOURCE_DIR}/cmake/QwsmEmbed.cmake
    DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/QwsmEmbed.cmake
    COMMENT "Embedding ${folder}" VERBATIM)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

string(REPLACE "|" ";" files "${FILES}")
set(source "")
foreach(name IN LISTS files)
  file(READ ${FOLDER}/${name} content)
  # A raw literal keeps all but its own end as it is.
  string(APPEND source "QWSM_FILE(\"/${name}\", R\"qwsm-file(${content})qwsm-file\")\n")
endforeach()
file(WRITE ${OUTPUT} "${source}")
