# cmake -DSOURCE= -DOUTPUT= -P WriteCommit.cmake: a header with the commit that SOURCE is at, with a + where files differ
# from it; empty where git knows of none. It is written only if that has changed.
cmake_minimum_required(VERSION 3.25)
set(commit "")
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE head RESULT_VARIABLE status
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(status EQUAL 0)
    set(commit ${head})
    execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD RESULT_VARIABLE status ERROR_QUIET)
    if(NOT status EQUAL 0)
        string(APPEND commit "+")
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n\n#define VDBCAGE_COMMIT \"${commit}\"\n")
