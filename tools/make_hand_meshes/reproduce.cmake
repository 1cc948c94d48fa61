# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
# Makes the meshes of a hand anew and compares them, byte by byte, with those beside its shapes.yaml.
# cmake -DGENERATOR=make_hand_meshes -DHAND=data/hands/NAME -DOUTPUT=folder -P reproduce.cmake
file(REMOVE_RECURSE ${OUTPUT})
file(MAKE_DIRECTORY ${OUTPUT}/meshes)
file(COPY ${HAND}/shapes.yaml DESTINATION ${OUTPUT})
execute_process(COMMAND ${GENERATOR} ${OUTPUT} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the generator failed: ${failed}")
endif()
file(GLOB made RELATIVE ${OUTPUT}/meshes ${OUTPUT}/meshes/*.obj)
file(GLOB kept RELATIVE ${HAND}/meshes ${HAND}/meshes/*.obj)
if(NOT made OR NOT made STREQUAL kept)
  message(FATAL_ERROR "meshes made: ${made}\nmeshes kept: ${kept}")
endif()
foreach(mesh IN LISTS made)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${OUTPUT}/meshes/${mesh} ${HAND}/meshes/${mesh}
                  RESULT_VARIABLE differs)
  if(differs)
    message(SEND_ERROR "${HAND}/meshes/${mesh} is not what shapes.yaml makes; run make_hand_meshes ${HAND}")
  endif()
endforeach()
