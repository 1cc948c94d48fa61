# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# eigengrasp_test(NAME LABEL label SOURCES file... LIBS target... [TIMEOUT seconds])
# A GoogleTest program, one ctest a program, labelled unit, property, golden, slow, store, e2e or lint. The tests find shipped data through
# EIGENGRASP_SOURCE_DIR and data that is not ours through the environment variable EIGENGRASP_DATA.
function(eigengrasp_test name)
  cmake_parse_arguments(arg "" "LABEL;TIMEOUT" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE eigengrasp_options GTest::gtest_main ${arg_LIBS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE EIGENGRASP_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABEL}" TIMEOUT ${arg_TIMEOUT})
endfunction()
