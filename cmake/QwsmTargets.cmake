# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
#
# qwsm_target_defaults(TARGET): language level, warnings and floating-point rules of every target.

option(QWSM_WARNINGS_AS_ERRORS "Turn compiler warnings into errors (the presets do)" OFF)

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
    $<$<BOOL:${QWSM_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()
