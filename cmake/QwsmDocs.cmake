# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Target `docs`: the reference of the libraries' public headers as HTML, in build/<preset>/docs/html.
find_package(Doxygen QUIET)

if(DOXYGEN_FOUND)
  set(DOXYGEN_PROJECT_NAME "Q-WSM")
  set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
  set(DOXYGEN_USE_MDFILE_AS_MAINPAGE README.md)
  set(DOXYGEN_EXTRACT_ALL YES)
  set(DOXYGEN_QUIET YES)
  set(DOXYGEN_GENERATE_LATEX NO)
  set(DOXYGEN_WARN_IF_UNDOCUMENTED NO)
  set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
  doxygen_add_docs(docs qwsm/include README.md docs CHANGELOG.md CONTRIBUTING.md
    COMMENT "Writing the reference")
endif()
