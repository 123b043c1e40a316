# cpack makes the four packages, and lintian finds nothing in them.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
set(packages ${build}/packages)
file(REMOVE_RECURSE ${packages})

run(${CMAKE_COMMAND} --preset packages -S ${source} -B ${build}_shared)
run(${CMAKE_COMMAND} --build ${build}_shared)
run(sh -c "umask 002 && cd '${build}_shared' && cpack -B '${packages}'") # as a new user of Debian 13 has it

string(REGEX MATCH "^[0-9]+\\.[0-9]+" series ${version})
execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE)
set(expected "")
foreach(package libvdbcage-dev libvdbcage${series} python3-vdbcage vdbcage)
    list(APPEND expected ${package}_${version}-0vdbcage1_${architecture}.deb)
endforeach()
file(GLOB made RELATIVE ${packages} ${packages}/*.deb)
if(NOT made STREQUAL expected)
    message(FATAL_ERROR "the packages are ${made}, not ${expected}")
endif()
list(TRANSFORM made PREPEND ${packages}/)
# --fail-on says only what the exit status is of; whatever lintian prints is a fault.
execute_process(COMMAND lintian --allow-root --tag-display-limit 0 ${made} RESULT_VARIABLE status
    OUTPUT_VARIABLE tags ERROR_VARIABLE tags)
if(NOT status EQUAL 0 OR NOT tags STREQUAL "")
    message(FATAL_ERROR "lintian (${status}):\n${tags}")
endif()
