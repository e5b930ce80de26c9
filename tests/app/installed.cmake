# An installed program finds its samples beside itself. BUILD: the build folder; SCRATCH: where to install.
file(REMOVE_RECURSE ${SCRATCH})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
foreach(file bin/limn share/limn/resources/icons/limn.png share/limn/projects/cornell/cornell.limn)
  if(NOT EXISTS ${SCRATCH}/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=LIMN_PROJECTS ${SCRATCH}/bin/limn info cornell
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE said)
if(NOT said MATCHES "share/limn/projects/cornell/cornell.gltf")
  message(FATAL_ERROR "it read another sample: ${said}")
endif()
file(REMOVE_RECURSE ${SCRATCH})
