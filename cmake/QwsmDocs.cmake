# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# Target `docs`: all pages and the reference of the libraries' public headers as one site, in
# build/<preset>/docs/html. It fails where Doxygen has something to warn of.
find_package(Doxygen 1.9 QUIET)
find_package(Python3 3.9 QUIET COMPONENTS Interpreter)

if(DOXYGEN_FOUND AND Python3_FOUND)
  set(DOXYGEN_PROJECT_NAME "Q-WSM")
  set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
  set(DOXYGEN_USE_MDFILE_AS_MAINPAGE README.md)
  set(DOXYGEN_FILTER_PATTERNS
    "*.md=\"${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/packaging/page_filter.py ${PROJECT_SOURCE_DIR}\"")
  set(DOXYGEN_VERBATIM_VARS DOXYGEN_FILTER_PATTERNS)
  set(DOXYGEN_IMAGE_PATH docs/pictures)
  set(DOXYGEN_EXCLUDE_PATTERNS "*/detail/*")
  set(DOXYGEN_STRIP_FROM_PATH
    qwsm/include slam6d/include service/io/include service/graph/include ${PROJECT_SOURCE_DIR})
  set(DOXYGEN_STRIP_FROM_INC_PATH ${DOXYGEN_STRIP_FROM_PATH})
  set(DOXYGEN_HTML_EXTRA_STYLESHEET packaging/site.css)
  set(DOXYGEN_GENERATE_TREEVIEW YES)
  set(DOXYGEN_FULL_SIDEBAR NO)
  set(DOXYGEN_TOC_INCLUDE_HEADINGS 2)
  set(DOXYGEN_HTML_TIMESTAMP NO)
  set(DOXYGEN_VERBATIM_HEADERS NO)
  set(DOXYGEN_HAVE_DOT NO)
  set(DOXYGEN_EXTRACT_ALL YES)
  set(DOXYGEN_QUIET YES)
  set(DOXYGEN_GENERATE_LATEX NO)
  set(DOXYGEN_WARN_IF_UNDOCUMENTED NO)
  set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO)
  set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
  doxygen_add_docs(docs
    README.md docs CHANGELOG.md CONTRIBUTING.md
    qwsm/include slam6d/include service/io/include service/graph/include
    COMMENT "Writing the site")
  # Pages of which there is no source any more would stay.
  add_custom_target(docs_clean COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/docs/html)
  add_dependencies(docs docs_clean)
endif()
install(DIRECTORY ${PROJECT_BINARY_DIR}/docs/html COMPONENT qwsm-doc OPTIONAL
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/qwsm)
