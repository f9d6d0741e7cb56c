# PUBLIC, because everything linked into one program must agree on the sanitizers.
function(insonify_enable_sanitizers target)
  if(INSONIFY_SANITIZE)
    set(flags -fsanitize=${INSONIFY_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
              -Wno-maybe-uninitialized)  # GCC sees phantoms in code that sanitizers have been through.
    target_compile_options(${target} PUBLIC ${flags})
    target_link_options(${target} PUBLIC ${flags})
  endif()
endfunction()
