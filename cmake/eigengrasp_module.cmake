# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# eigengrasp_module(NAME [DEPENDS module...] [PUBLIC lib...] [PRIVATE lib...])
# One static library per module: src/NAME/*.cpp, public headers include/eigengrasp/NAME/*.hpp.
# docs/layers.txt says which modules a module may include; tests/lint checks it.
function(eigengrasp_module name)
  cmake_parse_arguments(arg "" "" "DEPENDS;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp ${PROJECT_SOURCE_DIR}/src/${name}/*/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/eigengrasp/${name}/*.hpp)
  if(NOT sources)
    return()
  endif()
  add_library(eigengrasp_${name} STATIC ${sources})
  add_library(eigengrasp::${name} ALIAS eigengrasp_${name})
  set_target_properties(eigengrasp_${name} PROPERTIES EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON)
  target_sources(eigengrasp_${name} PUBLIC FILE_SET HEADERS
                 BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${headers})
  target_include_directories(eigengrasp_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM arg_DEPENDS PREPEND eigengrasp::)
  target_link_libraries(eigengrasp_${name} PUBLIC ${arg_DEPENDS} ${arg_PUBLIC}
                        PRIVATE $<BUILD_INTERFACE:eigengrasp_options> ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY EIGENGRASP_MODULES ${name})
endfunction()
