# cmake -Dctest=COMMAND -Dbuild=FOLDER -P labels.cmake: every test has one of the labels of tests/CMakeLists.txt.
execute_process(COMMAND ${ctest} --test-dir ${build} -N -LE "^(quick|slow|system|shells|blender|farm)$"
    OUTPUT_VARIABLE tests COMMAND_ERROR_IS_FATAL ANY)
if(NOT tests MATCHES "Total Tests: 0\n")
    message(FATAL_ERROR "These have no label:\n${tests}")
endif()
