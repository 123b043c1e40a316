# Finds what the library is built on; used by the build and, installed, by the package configuration.
#
# A function, because Debian's FindOpenVDB.cmake sets BUILD_SHARED_LIBS and other variables in its caller, and because
# TBB's own package must be found before it (after it is a hard error).
function(vdbcage_find_dependencies)
    set(CMAKE_MESSAGE_LOG_LEVEL NOTICE) # FindOpenVDB reports every optional file that it does not need
    list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
    find_package(TBB CONFIG REQUIRED)
    find_package(OpenVDB REQUIRED COMPONENTS openvdb)
    find_package(OpenMesh REQUIRED)
    find_package(Qhull CONFIG REQUIRED)
    find_package(ZLIB REQUIRED)
endfunction()
