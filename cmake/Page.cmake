# Puts the files of the viewer's page (web/) inside the program, and a table of them.
function(insonify_embed_page target folder)
  enable_language(ASM)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*)
  list(SORT files)
  set(assembly "    .section .rodata\n")
  set(declarations "")
  set(rows "")
  set(index 0)
  foreach(file IN LISTS files)
    string(APPEND assembly
      "    .global insonify_page_${index}_begin\n    .global insonify_page_${index}_end\n    .balign 16\n"
      "insonify_page_${index}_begin:\n    .incbin \"${folder}/${file}\"\ninsonify_page_${index}_end:\n")
    string(APPEND declarations
      "extern const char insonify_page_${index}_begin, insonify_page_${index}_end;  // NOLINT\n")
    string(APPEND rows "      {\"/${file}\", {&insonify_page_${index}_begin, &insonify_page_${index}_end}},\n")
    list(APPEND depends ${folder}/${file})
    math(EXPR index "${index} + 1")
  endforeach()
  string(APPEND assembly "    .section .note.GNU-stack,\"\",%progbits\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/page.S CONTENT "${assembly}" @ONLY)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/page_table.cpp @ONLY CONTENT
"// Made by cmake/Page.cmake: the files of the viewer's page.

#include \"serve/page_files.h\"

extern \"C\" {
${declarations}}

namespace insonify {

const std::map<std::string_view, PageBytes>& page_table() {
  static const std::map<std::string_view, PageBytes> kTable = {
${rows}  };
  return kTable;
}

}  // namespace insonify
")
  set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/page.S PROPERTIES OBJECT_DEPENDS "${depends}")
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/page.S ${CMAKE_CURRENT_BINARY_DIR}/page_table.cpp)
endfunction()
