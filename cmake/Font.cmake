# Puts DejaVu Sans inside the library, so that labels look alike on every machine and no font file has to be found later.
find_file(INSONIFY_FONT DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/dejavu
  CMAKE_FIND_ROOT_PATH_BOTH REQUIRED)
enable_language(ASM)
file(WRITE ${PROJECT_BINARY_DIR}/font.S
"    .section .rodata
    .global insonify_font_begin
    .global insonify_font_end
    .balign 16
insonify_font_begin:
    .incbin \"${INSONIFY_FONT}\"
insonify_font_end:
    .section .note.GNU-stack,\"\",%progbits
")
target_sources(insonify PRIVATE ${PROJECT_BINARY_DIR}/font.S)
