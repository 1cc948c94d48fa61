# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# cmake --install: libraries with their headers, the program, shipped data, and a package for find_package(eigengrasp).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(eigengrasp_modules GLOBAL PROPERTY EIGENGRASP_MODULES)
list(TRANSFORM eigengrasp_modules PREPEND eigengrasp_ OUTPUT_VARIABLE eigengrasp_libraries)

# Whoever uses the headers needs C++20 as well.
foreach(library ${eigengrasp_libraries})
  target_compile_features(${library} INTERFACE cxx_std_20)
endforeach()

# eigengrasp::eigengrasp is all modules.
add_library(eigengrasp_all INTERFACE)
add_library(eigengrasp::eigengrasp ALIAS eigengrasp_all)
set_target_properties(eigengrasp_all PROPERTIES EXPORT_NAME eigengrasp)
list(TRANSFORM eigengrasp_modules PREPEND eigengrasp:: OUTPUT_VARIABLE eigengrasp_aliases)
target_link_libraries(eigengrasp_all INTERFACE ${eigengrasp_aliases})

install(TARGETS ${eigengrasp_libraries} eigengrasp_all EXPORT eigengraspTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} FILE_SET HEADERS)
if(TARGET eigengrasp)
  install(TARGETS eigengrasp RUNTIME)
endif()

set(eigengrasp_data_folder ${CMAKE_INSTALL_DATADIR}/eigengrasp)
foreach(kind hands objects grasps)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/${kind} DESTINATION ${eigengrasp_data_folder}
          PATTERN shapes.yaml EXCLUDE)  # input of the mesh generator
endforeach()
# The web app, where it was built before (./run serve, or npm in the folder viewer).
install(DIRECTORY ${PROJECT_SOURCE_DIR}/viewer/dist/ DESTINATION ${eigengrasp_data_folder}/viewer OPTIONAL)

set(eigengrasp_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/eigengrasp)
install(EXPORT eigengraspTargets NAMESPACE eigengrasp:: DESTINATION ${eigengrasp_package_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/eigengraspConfig.cmake.in eigengraspConfig.cmake
                              INSTALL_DESTINATION ${eigengrasp_package_folder}
                              PATH_VARS eigengrasp_data_folder)
write_basic_package_version_file(eigengraspConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/eigengraspConfig.cmake ${PROJECT_BINARY_DIR}/eigengraspConfigVersion.cmake
        DESTINATION ${eigengrasp_package_folder})
