# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Writes a C++ source with the contents of text files as string literals, a line `QWSM_FILE("/name",
# R"...")` for each, to be included where QWSM_FILE is defined.
#   cmake -D FOLDER=... -D FILES=a;b -D OUTPUT=... -P EmbedFiles.cmake
set(source "")
foreach(name IN LISTS FILES)
  file(READ ${FOLDER}/${name} content)
  # A raw literal keeps all but its own end as it is, and compilers allow some 64 KB in one.
  string(APPEND source "QWSM_FILE(\"/${name}\", R\"qwsm-file(${content})qwsm-file\")\n")
endforeach()
file(WRITE ${OUTPUT} "${source}")
