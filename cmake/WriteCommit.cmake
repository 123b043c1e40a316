# cmake -DSOURCE= -DOUTPUT= -P WriteCommit.cmake: a header with the commit that SOURCE is at, with a + where files differ
# from it; empty where SOURCE is no repository of its own. It is written only if that has changed.
cmake_minimum_required(VERSION 3.25)
set(git ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0 git -C ${SOURCE}) # nobody's commit has to wait for it
set(commit "")
execute_process(COMMAND ${git} rev-parse --show-prefix OUTPUT_VARIABLE prefix RESULT_VARIABLE status
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(status EQUAL 0 AND prefix STREQUAL "") # else it is below another project's repository
    execute_process(COMMAND ${git} rev-parse --short=12 HEAD OUTPUT_VARIABLE head RESULT_VARIABLE status
        OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(status EQUAL 0)
        set(commit ${head})
        execute_process(COMMAND ${git} diff --quiet HEAD RESULT_VARIABLE status ERROR_QUIET)
        if(NOT status EQUAL 0)
            string(APPEND commit "+")
        endif()
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n\n#define VDBCAGE_COMMIT \"${commit}\"\n")
