# cmake -DCLANG_FORMAT=COMMAND -P cmake/CheckFormat.cmake: fails unless all sources are as clang-format would write them.
cmake_minimum_required(VERSION 3.25)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
file(GLOB_RECURSE files ${root}/vdbcage/*.h ${root}/vdbcage/*.cpp ${root}/tools/*.h ${root}/tools/*.cpp
    ${root}/tests/*.h ${root}/tests/*.cpp ${root}/examples/*.cpp)
list(LENGTH files count)
if(count LESS 20)
    message(FATAL_ERROR "only ${count} files were found below ${root}")
endif()
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files} RESULT_VARIABLE status ERROR_VARIABLE problems)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "Not formatted (clang-format -i FILE...):\n${problems}")
endif()
message(STATUS "${count} files are formatted")
