# Installs insonify to a fresh prefix, then builds and runs a project that finds it there.
#   BUILD_DIR        a built tree of insonify; or
#   SOURCE_DIR       sources of insonify, to be built first as a static library in WORK_DIR/static
#   WORK_DIR         where to do all this
#   COMPILER         C++ compiler
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${prefix} ${WORK_DIR}/staged ${WORK_DIR}/consumer)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output ${output} PARENT_SCOPE)
endfunction()

if(SOURCE_DIR)
  set(BUILD_DIR ${WORK_DIR}/static)
  run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE_DIR} -B ${BUILD_DIR} -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_CXX_COMPILER=${COMPILER} -DBUILD_SHARED_LIBS=OFF -DINSONIFY_BUILD_TESTS=OFF -DINSONIFY_BUILD_APPS=OFF)
  run(${CMAKE_COMMAND} --build ${BUILD_DIR})
endif()
# Moved after the installation, which must not matter.
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/staged)
file(RENAME ${WORK_DIR}/staged ${prefix})
run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR}/consumer -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/consumer)
run(${WORK_DIR}/consumer/consumer ${WORK_DIR}/ping.h5)
message("${output}")
# A program that the static library is a part of does not know where that was installed.
if(NOT SOURCE_DIR AND NOT output MATCHES "preset from ${prefix}/share/insonify/presets/tritech-micron-dst.yaml")
  message(FATAL_ERROR "The presets installed in ${prefix} were not used")
endif()
if(EXISTS ${prefix}/bin/insonify)
  run(${prefix}/bin/insonify version)
endif()
