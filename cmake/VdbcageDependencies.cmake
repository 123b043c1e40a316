# Finds what the library is built on; used by the build and, installed, by the package configuration.
#
# vdbcage_find_dependencies(MISSING [ALL]): targets of what public headers include, with ALL of what the library is
# linked to, too. The variable MISSING is then a list of what was not found. Nothing is looked for in a fixed place:
# CMake's own variables (CMAKE_PREFIX_PATH, OpenVDB_ROOT, CMAKE_MODULE_PATH, a toolchain's) decide.
#
# A function, because OpenVDB's FindOpenVDB.cmake sets BUILD_SHARED_LIBS and other variables in its caller, and because
# TBB's own package must be found before it (after it is a hard error).
function(vdbcage_find_dependencies missing)
    cmake_parse_arguments(PARSE_ARGV 1 argument "ALL" "" "")
    set(CMAKE_POLICY_DEFAULT_CMP0167 NEW) # FindOpenVDB looks for Boost, and knows no policies of later versions of CMake
    set(CMAKE_MESSAGE_LOG_LEVEL NOTICE) # FindOpenVDB reports every optional file that it does not need
    find_package(TBB CONFIG QUIET)
    # Its package configuration, or a module of the user's; else the module that OpenVDB installs beside its library.
    if(TARGET TBB::tbb) # else the module ends in an error of its own
        find_package(OpenVDB QUIET COMPONENTS openvdb)
    endif()
    if(TARGET TBB::tbb AND NOT TARGET OpenVDB::openvdb)
        find_library(OpenVDB_openvdb_LIBRARY openvdb HINTS ${OpenVDB_ROOT} $ENV{OpenVDB_ROOT} PATH_SUFFIXES lib lib64)
        if(OpenVDB_openvdb_LIBRARY)
            get_filename_component(folder ${OpenVDB_openvdb_LIBRARY} DIRECTORY)
            list(APPEND CMAKE_MODULE_PATH ${folder}/cmake/OpenVDB)
            find_package(OpenVDB QUIET COMPONENTS openvdb)
        endif()
    endif()
    set(targets TBB::tbb OpenVDB::openvdb)

    if(argument_ALL)
        find_package(OpenMesh CONFIG QUIET)
        find_package(Qhull CONFIG QUIET)
        find_package(ZLIB QUIET)
        list(APPEND targets OpenMeshCore ZLIB::ZLIB)
        if(NOT TARGET Qhull::qhullstatic_r)
            list(APPEND targets Qhull::qhull_r)
        endif()
        # These have no package configuration, or one of another name in each distribution.
        foreach(name blosc gmp mpfr)
            find_path(VDBCAGE_${name}_INCLUDE_DIR ${name}.h)
            find_library(VDBCAGE_${name}_LIBRARY NAMES ${name} lib${name})
            mark_as_advanced(VDBCAGE_${name}_INCLUDE_DIR VDBCAGE_${name}_LIBRARY)
            if(VDBCAGE_${name}_INCLUDE_DIR AND VDBCAGE_${name}_LIBRARY AND NOT TARGET vdbcage::${name})
                set(scope "")
                if(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL)
                    set(scope GLOBAL)
                endif()
                add_library(vdbcage::${name} UNKNOWN IMPORTED ${scope})
                set_target_properties(vdbcage::${name} PROPERTIES IMPORTED_LOCATION ${VDBCAGE_${name}_LIBRARY}
                    INTERFACE_INCLUDE_DIRECTORIES ${VDBCAGE_${name}_INCLUDE_DIR})
            endif()
            list(APPEND targets vdbcage::${name})
        endforeach()
    endif()

    set(notFound "")
    foreach(target IN LISTS targets)
        if(NOT TARGET ${target})
            string(REGEX REPLACE ".*::|Core$" "" name ${target})
            list(APPEND notFound ${name})
        endif()
    endforeach()
    set(${missing} "${notFound}" PARENT_SCOPE)
endfunction()
