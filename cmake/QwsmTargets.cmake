# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# qwsm_target_defaults(TARGET): language level, warnings and floating-point rules of every target.
# qwsm_optimise_little(TARGET): for sources that take long to compile and have no time to win.
# qwsm_add_precompiled(NAME LIBS ... HEADERS ...): headers that are parsed once, for all who take them.
# qwsm_take_precompiled(TARGET NAME): begins every source of TARGET with these headers.
# qwsm_build_together(TARGET [AT_MOST N] [EXCEPT ...]): compiles the sources of TARGET together, N at a
# time or all, but for those named.

option(QWSM_WARNINGS_AS_ERRORS "Turn compiler warnings into errors (the presets do)" OFF)
option(QWSM_SEPARATE_SOURCES
  "Compile every source by itself, with no header but its own: slower, and finds forgotten includes" OFF)

function(qwsm_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wold-style-cast>
    # Notes that a calling convention changed with GCC 4.6 help nobody.
    -Wno-psabi
    # GCC 12 warns wrongly of `"text" + std::string` (its bug 105651).
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    # Clang counts changes of sign to -Wconversion, GCC does not: the same code passes both.
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:Clang>>:-Wno-sign-conversion>
    # Fused multiply-adds would make results depend on the machine: a replay has to be bit-exact.
    -ffp-contract=off
    # These change no result. Public functions may be inlined within a library, for nobody exchanges them at
    # run time; roots set no errno, and comparisons raise no traps.
    -fno-semantic-interposition -fno-math-errno -fno-trapping-math
    # GCC collects garbage from 128 MB on, which precompiled headers alone exceed; from 512 MB on it
    # takes 50 MB more memory and a tenth less time.
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=524288>
    $<$<BOOL:${QWSM_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

function(qwsm_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

function(qwsm_add_precompiled name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBS;HEADERS")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  qwsm_target_defaults(${name})
  target_link_libraries(${name} PRIVATE ${arg_LIBS})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

function(qwsm_take_precompiled target name)
  if(NOT QWSM_SEPARATE_SOURCES)
    target_precompile_headers(${target} REUSE_FROM ${name})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE)
      # The headers are compiled as code of libraries: what programs are compiled to must be like it.
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${target} PRIVATE -fPIC)
    endif()
  endif()
endfunction()

function(qwsm_build_together target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "AT_MOST" "EXCEPT")
  if(NOT arg_AT_MOST)
    set(arg_AT_MOST 0)  # All.
  endif()
  if(NOT QWSM_SEPARATE_SOURCES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${arg_AT_MOST})
    set_source_files_properties(${arg_EXCEPT} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()
