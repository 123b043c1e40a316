# cmake -DSOURCE=FOLDER -DWORK=FOLDER -P missing.cmake
# Configures as if some packages were not installed: one message names them all, and the options that do without them.
cmake_minimum_required(VERSION 3.25)
set(words "")
foreach(package TBB OpenMesh Qhull CLI11 PNG glfw3 pybind11)
    list(APPEND words -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
file(REMOVE_RECURSE ${WORK}/missing)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/missing --preset release ${words}
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE message)
file(REMOVE_RECURSE ${WORK}/missing)
string(REGEX REPLACE "[ \n]+" " " message "${message}")
string(REGEX MATCHALL "CMake Error" errors "${message}")
list(LENGTH errors errors)
set(problems "")
if(status EQUAL 0 OR NOT errors EQUAL 1)
    string(APPEND problems "status ${status}, ${errors} errors instead of one\n")
endif()
foreach(part "tbb (libtbb-dev)," "openvdb (libopenvdb-dev)," "OpenMesh (libopenmesh-dev)," "qhull (libqhull-dev),"
        "CLI11 2.1 (libcli11-dev, or -DVDBCAGE_BUILD_TOOLS=OFF)," "libpng (libpng-dev, or -DVDBCAGE_BUILD_TOOLS=OFF),"
        "pybind11 2.10 (pybind11-dev, or -DVDBCAGE_BUILD_PYTHON=OFF),"
        "GLFW 3.3 (libglfw3-dev, or -DVDBCAGE_BUILD_VIEW=OFF)."
        "apt install libtbb-dev libopenvdb-dev libopenmesh-dev libqhull-dev libcli11-dev libpng-dev pybind11-dev libglfw3-dev.")
    string(FIND "${message}" "${part}" place)
    if(place LESS 0)
        string(APPEND problems "'${part}' is not said\n")
    endif()
endforeach()
if(problems)
    message(FATAL_ERROR "${problems}${message}")
endif()
