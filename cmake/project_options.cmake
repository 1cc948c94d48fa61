# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# Language, warnings, sanitizers, compiler cache and linker of every target.
option(EIGENGRASP_DEVELOPER "Build tests and benchmarks, warnings are errors" OFF)
option(EIGENGRASP_FUZZ "Build the fuzz targets with libFuzzer (needs clang)" OFF)
set(EIGENGRASP_SANITIZE "" CACHE STRING "Sanitizers to build with, such as address,undefined")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(eigengrasp_options INTERFACE)
target_compile_options(eigengrasp_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(EIGENGRASP_DEVELOPER)
  target_compile_options(eigengrasp_options INTERFACE -Werror)
endif()
if(EIGENGRASP_SANITIZE)
  target_compile_options(eigengrasp_options INTERFACE -fsanitize=${EIGENGRASP_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # GCC 12 warns of its own string::operator= where a sanitizer keeps it from seeing the lengths.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(eigengrasp_options INTERFACE -Wno-restrict)
  endif()
  target_link_options(eigengrasp_options INTERFACE -fsanitize=${EIGENGRASP_SANITIZE})
endif()

find_program(EIGENGRASP_CCACHE ccache)
if(EIGENGRASP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${EIGENGRASP_CCACHE})
endif()
find_program(EIGENGRASP_MOLD mold)
if(EIGENGRASP_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
