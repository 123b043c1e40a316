# Everything that the build needs and does not find is said at once, with Debian's package that has it and the option
# that does without it: whoever has none of it should not need ten tries.

# vdbcage_need(FOUND NAME PACKAGE [OPTION]): FOUND, a variable or FALSE, says whether NAME was found, which -DOPTION=OFF
# does not need. The build goes on without it until vdbcage_stop_if_missing().
function(vdbcage_need found name package)
    if(NOT ${found})
        set(without "")
        if(ARGN)
            set(without ", or -D${ARGV3}=OFF")
        endif()
        set_property(GLOBAL APPEND PROPERTY VDBCAGE_MISSING "${name} (${package}${without})")
        set_property(GLOBAL APPEND PROPERTY VDBCAGE_MISSING_PACKAGES ${package})
    endif()
endfunction()

# vdbcage_stop_if_missing(): ends with one message where anything is missing.
function(vdbcage_stop_if_missing)
    get_property(missing GLOBAL PROPERTY VDBCAGE_MISSING)
    if(NOT missing)
        return()
    endif()
    get_property(packages GLOBAL PROPERTY VDBCAGE_MISSING_PACKAGES)
    list(REMOVE_DUPLICATES missing)
    list(REMOVE_DUPLICATES packages)
    list(JOIN missing ", " missing)
    list(JOIN packages " " packages)
    message(FATAL_ERROR "vdbcage cannot be built without: ${missing}. On Debian: apt install ${packages}. "
        "Elsewhere CMAKE_PREFIX_PATH says where they are.")
endfunction()
