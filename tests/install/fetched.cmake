cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
set(work ${build}_fetched) # beside the others: a compiler cache sees the same relative paths
file(REMOVE_RECURSE ${work}/prefix)
run(${CMAKE_COMMAND} --fresh -S ${source}/tests/install/fetched -B ${work} -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_CXX_COMPILER_LAUNCHER=${launcher} -DVDBCAGE_SOURCE=${source}
    -DVDBCAGE_WARNINGS_AS_ERRORS=${strict} -DVDBCAGE_WITH_CGAL_GPL=OFF -DCMAKE_UNITY_BUILD=${unity})
run(${CMAKE_COMMAND} --build ${work})
run(${work}/fetched ${source}/data/bishop.obj ${work}/cage.obj)

run(${CMAKE_COMMAND} --install ${work} --prefix ${work}/prefix)
file(GLOB_RECURSE installed RELATIVE ${work}/prefix ${work}/prefix/*)
if(NOT installed STREQUAL "bin/fetched")
    message(FATAL_ERROR "with the project around it were installed: ${installed}")
endif()
