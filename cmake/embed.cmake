# awan_embed(NAME ROOTS FILES) compiles FILES into the program. Gives NAME_SOURCE, a generated .cpp that
# defines   std::span<const awan::EmbeddedFile> awan::NAME();   declared in core/base/embedded.h.
# File names are relative to that of the folders ROOTS which they lie in. FILES are texts.
set(AWAN_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)
function(awan_embed name roots files)
    set(source ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
    set(list ${CMAKE_BINARY_DIR}/generated/${name}.list)
    file(CONFIGURE OUTPUT ${list} CONTENT "${files}" @ONLY)
    add_custom_command(OUTPUT ${source}
        COMMAND ${CMAKE_COMMAND} -DNAME=${name} "-DROOTS=${roots}" -DLIST=${list} -DOUT=${source} -P ${AWAN_EMBED_SCRIPT}
        DEPENDS ${files} ${list} ${AWAN_EMBED_SCRIPT} VERBATIM)
    set(${name}_SOURCE ${source} PARENT_SCOPE)
endfunction()
