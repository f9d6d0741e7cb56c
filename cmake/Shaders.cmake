# The engine `gpu` is built where Vulkan's headers and a compiler of shaders are; it opens the library of Vulkan when it starts.
find_path(INSONIFY_VULKAN_HEADERS vulkan/vulkan_core.h)
find_program(INSONIFY_GLSLC glslc)
if(INSONIFY_VULKAN_HEADERS AND INSONIFY_GLSLC)
  set(INSONIFY_GPU ON)
else()
  set(INSONIFY_GPU OFF)
  message(STATUS "No engine gpu: it needs libvulkan-dev and glslc")
endif()

# insonify_shaders(TARGET FOLDER): compiles FOLDER/*.comp; each is an array of that name in the header "shaders/NAME.inc".
function(insonify_shaders target folder)
  file(GLOB shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.comp)
  file(GLOB parts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.glsl
    ${PROJECT_SOURCE_DIR}/${folder}/*.h ${PROJECT_SOURCE_DIR}/src/echo/laws/*.h)
  set(output ${PROJECT_BINARY_DIR}/shaders/shaders)
  file(MAKE_DIRECTORY ${output})
  set(compiled)
  foreach(shader IN LISTS shaders)
    cmake_path(GET shader STEM name)
    add_custom_command(OUTPUT ${output}/${name}.inc
      COMMAND ${INSONIFY_GLSLC} --target-env=vulkan1.3 -O -mfmt=num -I ${PROJECT_SOURCE_DIR}/src ${shader} -o ${output}/${name}.inc
      DEPENDS ${shader} ${parts} VERBATIM)
    list(APPEND compiled ${output}/${name}.inc)
  endforeach()
  target_sources(${target} PRIVATE ${compiled})
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/shaders)
endfunction()
