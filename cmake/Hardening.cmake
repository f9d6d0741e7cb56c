# Makes faults harder to exploit: a smashed stack or an overrun buffer ends the program, and the tables through which
# library functions are called are read-only once it runs. tests/install/linkage_test.py looks for all of it.
include(CheckPIESupported)
check_pie_supported()

function(insonify_harden target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_options(${target} PRIVATE LINKER:-z,relro,-z,now,-z,noexecstack)
  if(NOT INSONIFY_SANITIZE)  # Sanitizers have checks of their own in the same places.
    target_compile_options(${target} PRIVATE -fstack-protector-strong
      $<$<AND:$<NOT:$<CONFIG:Debug,>>,$<COMPILE_LANGUAGE:C,CXX>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
  endif()
endfunction()
