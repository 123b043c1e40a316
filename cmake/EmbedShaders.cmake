# Turns GLSL files into C++ constants at build time, so that no program looks for its shaders when it runs.
#
#   vdbcage_embed_shaders(TARGET FOLDER FILES...)
#
# Makes <shaders/FOLDER.h> for TARGET: for each file of shaders/FOLDER, say line.vert, a gl::ShaderSource named
# vdbcage::shaders::lineVert. A file's extension tells its stage: vert, geom, frag or comp. A line `#include "face.glsl"`
# stands for that file of the same folder, which is no stage and includes nothing; it too is in FILES.

if(CMAKE_SCRIPT_MODE_FILE)
    # The build step: cmake -DFOLDER= -DSOURCE= -DFILES=a,b -DOUTPUT= -P EmbedShaders.cmake
    set(stage_vert GL_VERTEX_SHADER)
    set(stage_geom GL_GEOMETRY_SHADER)
    set(stage_frag GL_FRAGMENT_SHADER)
    set(stage_comp GL_COMPUTE_SHADER)
    string(REPLACE "," ";" FILES "${FILES}")
    set(text "// Made from shaders/${FOLDER} by cmake/EmbedShaders.cmake.\n#pragma once\n\n")
    string(APPEND text "#include <vdbcage/gl/program.h>\n\nnamespace vdbcage::shaders {\n")
    foreach(file ${FILES})
        if(file MATCHES "\\.glsl$")
            file(READ ${SOURCE}/${file} included_${file})
        endif()
    endforeach()
    foreach(file ${FILES})
        if(file MATCHES "\\.glsl$")
            continue()
        endif()
        if(NOT file MATCHES "^([a-z][A-Za-z]*)\\.(vert|geom|frag|comp)$")
            message(FATAL_ERROR "shaders/${FOLDER}/${file}: a name like lineWide.vert is needed (vert, geom, frag, comp, glsl)")
        endif()
        set(name ${CMAKE_MATCH_1})
        set(extension ${CMAKE_MATCH_2})
        string(SUBSTRING ${extension} 0 1 initial)
        string(TOUPPER ${initial} initial)
        string(SUBSTRING ${extension} 1 -1 rest)
        file(READ ${SOURCE}/${file} glsl)
        foreach(included ${FILES})
            if(DEFINED included_${included})
                string(REPLACE "#include \"${included}\"\n" "${included_${included}}" glsl "${glsl}")
            endif()
        endforeach()
        if(glsl MATCHES "#include")
            message(FATAL_ERROR "shaders/${FOLDER}/${file}: includes a file that is not embedded with it")
        endif()
        string(APPEND text "\ninline constexpr gl::ShaderSource ${name}${initial}${rest}{${stage_${extension}}, "
            "\"${FOLDER}/${file}\", R\"glsl(${glsl})glsl\"};\n")
    endforeach()
    string(APPEND text "\n} // namespace vdbcage::shaders\n")
    file(WRITE ${OUTPUT} "${text}")
    return()
endif()

set(VDBCAGE_EMBED_SHADERS_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(vdbcage_embed_shaders target folder)
    set(source ${PROJECT_SOURCE_DIR}/shaders/${folder})
    set(include ${CMAKE_CURRENT_BINARY_DIR}/embedded)
    set(header ${include}/shaders/${folder}.h)
    list(TRANSFORM ARGN PREPEND ${source}/ OUTPUT_VARIABLE inputs)
    list(JOIN ARGN "," files)
    add_custom_command(OUTPUT ${header}
        COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DSOURCE=${source} -DFILES=${files} -DOUTPUT=${header}
            -P ${VDBCAGE_EMBED_SHADERS_SCRIPT}
        DEPENDS ${inputs} ${VDBCAGE_EMBED_SHADERS_SCRIPT}
        COMMENT "Embedding shaders/${folder}" VERBATIM)
    # A target of its own: the one that needs them may be another folder's.
    add_custom_target(${target}_${folder}_shaders DEPENDS ${header})
    add_dependencies(${target} ${target}_${folder}_shaders)
    add_dependencies(vdbcage_generated ${target}_${folder}_shaders)
    target_include_directories(${target} PRIVATE ${include})
endfunction()
