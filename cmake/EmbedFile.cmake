# Turns files into C++ arrays at build time, so that no program looks for them when it runs.
#
#   vdbcage_embed_files(TARGET NAME FILES...)
#
# Makes <embedded/NAME.h> for TARGET: for each file, say /usr/share/Inter-Regular.otf, an array of unsigned char named
# vdbcage::NAME::interRegular. Its size is the file's.

if(CMAKE_SCRIPT_MODE_FILE)
    # The build step: cmake -DNAME= -DFILES=a,b -DOUTPUT= (without .h and .cpp) -P EmbedFile.cmake
    string(REPLACE "," ";" FILES "${FILES}")
    set(header "// Made by cmake/EmbedFile.cmake.\n#pragma once\n\nnamespace vdbcage::${NAME} {\n\n")
    set(source "// Made by cmake/EmbedFile.cmake.\n#include <embedded/${NAME}.h>\n\nnamespace vdbcage::${NAME} {\n")
    foreach(file ${FILES})
        get_filename_component(stem ${file} NAME_WE)
        string(MAKE_C_IDENTIFIER "${stem}" name)
        string(REPLACE "_" "" name "${name}")
        string(SUBSTRING ${name} 0 1 initial)
        string(TOLOWER ${initial} initial)
        string(SUBSTRING ${name} 1 -1 rest)
        set(name ${initial}${rest})
        file(READ ${file} bytes HEX)
        string(LENGTH "${bytes}" digits)
        if(digits EQUAL 0)
            message(FATAL_ERROR "${file}: is empty")
        endif()
        math(EXPR size "${digits} / 2")
        string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
        string(APPEND header "extern const unsigned char ${name}[${size}]; // ${file}\n")
        string(APPEND source "\nconst unsigned char ${name}[${size}] = {${bytes}};\n")
    endforeach()
    file(WRITE ${OUTPUT}.h "${header}\n} // namespace vdbcage::${NAME}\n")
    file(WRITE ${OUTPUT}.cpp "${source}\n} // namespace vdbcage::${NAME}\n")
    return()
endif()

set(VDBCAGE_EMBED_FILE_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(vdbcage_embed_files target name)
    set(include ${CMAKE_CURRENT_BINARY_DIR}/embedded_files)
    set(output ${include}/embedded/${name})
    list(JOIN ARGN "," files)
    add_custom_command(OUTPUT ${output}.h ${output}.cpp
        COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DFILES=${files} -DOUTPUT=${output} -P ${VDBCAGE_EMBED_FILE_SCRIPT}
        DEPENDS ${ARGN} ${VDBCAGE_EMBED_FILE_SCRIPT}
        COMMENT "Embedding ${name}" VERBATIM)
    target_sources(${target} PRIVATE ${output}.cpp ${output}.h)
    target_include_directories(${target} PRIVATE ${include})
    add_custom_target(${target}_${name}_files DEPENDS ${output}.h ${output}.cpp)
    add_dependencies(vdbcage_generated ${target}_${name}_files)
endfunction()
