# With CMAKE_UNITY_BUILD, as the presets `release` and the sanitizers have it, the files of one folder are compiled as one:
# headers are parsed, and templates instantiated, once for all of them, in less than half of the time. Pings are as fast: of
# five scenes, 2 % faster to 1 % slower. Names of a file's own (in anonymous namespaces) must therefore be unique within a
# folder; the preset `dev` compiles file by file.
# insonify_unity(TARGET [EXCEPT REGEX] [TOGETHER REGEX]): files whose paths match EXCEPT are compiled one by one; files that include
# a header that matches TOGETHER, which takes long to compile, are compiled as one, whatever their folders.
function(insonify_unity target)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 given "" "EXCEPT;TOGETHER" "")
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
    if((given_EXCEPT AND path MATCHES "${given_EXCEPT}") OR path MATCHES "^\\.\\./")
      continue()
    endif()
    cmake_path(GET path PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    if(given_TOGETHER)
      file(STRINGS ${source} heavy REGEX "^#include .(${given_TOGETHER})")
      if(heavy)
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP together)
        continue()
      endif()
    endif()
    math(EXPR part "0${count_${group}} / 20")  # A larger folder in parts, so that every processor has some.
    math(EXPR count_${group} "0${count_${group}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
