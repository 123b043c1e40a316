cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
set(work ${build}/install_${kind})
file(REMOVE_RECURSE ${work}/prefix ${work}/examples)

set(library ${build})
if(kind STREQUAL "shared")
    set(library ${build}_shared) # beside the other: a compiler cache sees the same relative paths
    run(${CMAKE_COMMAND} -S ${source} -B ${library} -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON
        -DCMAKE_UNITY_BUILD=${unity}
        -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_CXX_COMPILER_LAUNCHER=${launcher} -DVDBCAGE_BUILD_TESTS=OFF
        -DVDBCAGE_WITH_CGAL_GPL=OFF -DVDBCAGE_WARNINGS_AS_ERRORS=${strict}
        -DVDBCAGE_BUILD_TOOLS=${tools} -DVDBCAGE_BUILD_VIEW=${view} -DVDBCAGE_BUILD_PYTHON=${python}
        # as they are without the test packages, which makes packages of the same build
        -DVDBCAGE_DEBIAN_PACKAGES=OFF -DCMAKE_INSTALL_PREFIX=/usr/local -DVDBCAGE_PYTHON_DIR=lib/python3/dist-packages)
    run(${CMAKE_COMMAND} --build ${library})
    # Ninja keeps what every object was compiled from.
    execute_process(COMMAND ninja -C ${library} -t deps OUTPUT_VARIABLE dependencies RESULT_VARIABLE status)
    if(NOT status EQUAL 0 OR NOT dependencies MATCHES "vdbcage/mesh/mesh\\.h")
        message(FATAL_ERROR "ninja -t deps told nothing")
    endif()
    # Every CGAL header names its licence: the kernel's is LGPL, the optional part's would be GPL.
    string(REGEX MATCHALL "/[^\n ]*/CGAL/[^\n ]*" headers "${dependencies}")
    list(REMOVE_DUPLICATES headers)
    list(LENGTH headers count)
    if(count LESS 100)
        message(FATAL_ERROR "only ${count} CGAL headers were found in the dependencies")
    endif()
    foreach(header IN LISTS headers)
        file(STRINGS ${header} licence REGEX "SPDX-License-Identifier: GPL" LIMIT_COUNT 1)
        if(licence)
            message(FATAL_ERROR "VDBCAGE_WITH_CGAL_GPL=OFF, but ${header} was compiled: ${licence}")
        endif()
    endforeach()
endif()

run(${CMAKE_COMMAND} --install ${library} --prefix ${work}/prefix)
file(GLOB_RECURSE private ${work}/prefix/include/*/detail/* ${work}/prefix/include/vdbcage/geometry/*
    ${work}/prefix/include/vdbcage/gl/* ${work}/prefix/include/vdbcage/mesh/io/*)
if(private)
    message(FATAL_ERROR "private headers were installed: ${private}")
endif()
run(${CMAKE_COMMAND} -S ${source}/examples -B ${work}/examples -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${work}/prefix -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_CXX_COMPILER_LAUNCHER=${launcher})
run(${CMAKE_COMMAND} --build ${work}/examples)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work}/examples --output-on-failure --no-tests=error)

file(GLOB folder ${work}/prefix/lib*/pkgconfig ${work}/prefix/lib*/*/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${folder})
set(ENV{LD_LIBRARY_PATH} ${folder}/..)
set(flags --cflags --libs)
if(kind STREQUAL "static")
    list(APPEND flags --static)
endif()
execute_process(COMMAND pkg-config ${flags} vdbcage OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${launcher} ${compiler} -c ${source}/examples/cage.cpp -o ${work}/by_pkg_config.o ${flags})
run(${compiler} ${work}/by_pkg_config.o -o ${work}/by_pkg_config ${flags})
run(${work}/by_pkg_config ${source}/data/bishop.obj ${work}/cage.obj)
unset(ENV{LD_LIBRARY_PATH})

if(kind STREQUAL "shared" AND tools) # programs and the module find the library from where they are
    run(${work}/prefix/bin/vdbcage check ${work}/cage.obj ${source}/data/bishop.obj)
    if(python)
        run(${CMAKE_COMMAND} -E env PYTHONPATH=${work}/prefix/lib/python3/dist-packages /usr/bin/python3
            ${source}/examples/twist.py ${source}/data/bishop.obj ${work}/twisted.obj)
    endif()
endif()
