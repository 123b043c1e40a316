# cmake [-DTAKE=ON] -Dbuild=build/release -P tests/abi/compare.cmake: compares the binary interface of the library with
# docs/dev/ABI.txt; with TAKE it writes the list instead. A program that was built with an older library of the same
# SOVERSION must still run: it depends on symbols, and on sizes and offsets in public types.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
get_filename_component(build ${build} ABSOLUTE)
set(kept ${root}/docs/dev/ABI.txt)
set(work ${build}/tests/abi)
run(${CMAKE_COMMAND} --build ${build} --target vdbcage_abi)

# What public headers do not define is private, or others'.
file(REMOVE_RECURSE ${work}/headers)
file(GLOB headers RELATIVE ${root} ${root}/vdbcage/*.h ${root}/vdbcage/*/*.h)
list(FILTER headers EXCLUDE REGEX "^vdbcage/(geometry|gl)/")
foreach(header IN LISTS headers)
    get_filename_component(folder ${header} DIRECTORY)
    file(COPY ${root}/${header} DESTINATION ${work}/headers/${folder})
endforeach()
file(WRITE ${work}/suppressions "[suppress_function]\nsymbol_name_not_regexp = ^_ZNK?7vdbcage\ndrop = yes
[suppress_variable]\nsymbol_name_not_regexp = ^_ZNK?7vdbcage\ndrop = yes\n")
# The newest: an older SOVERSION's may lie beside it.
file(READ_SYMLINK ${work}/libvdbcage.so library)
set(library ${work}/${library})
run(abidw --headers-dir ${work}/headers --drop-private-types --suppressions ${work}/suppressions
    --out-file ${work}/now.xml ${library})
string(REGEX REPLACE ".*\\.so\\." "" soversion ${library})
execute_process(COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/list.py ${work}/now.xml ${soversion}
    OUTPUT_FILE ${work}/now.txt COMMAND_ERROR_IS_FATAL ANY)
if(TAKE)
    file(COPY_FILE ${work}/now.txt ${kept})
    return()
endif()

file(STRINGS ${work}/now.txt lines)
list(LENGTH lines count)
if(count LESS 300)
    message(FATAL_ERROR "only ${count} functions, types and members were found in ${library}")
endif()
execute_process(COMMAND diff -U0 ${kept} ${work}/now.txt RESULT_VARIABLE status OUTPUT_VARIABLE changes)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "The binary interface is not what docs/dev/ABI.txt has.\n"
        "Where functions are only added, write the list anew. Else programs that were built before would fail: give the "
        "library a new SOVERSION first, by the version in vdbcage/core/version.h. To write it:\n"
        "  cmake -DTAKE=ON -Dbuild=build/release -P tests/abi/compare.cmake\n${changes}")
endif()
