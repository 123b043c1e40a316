cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
set(prefix ${build}/python_install)
file(REMOVE_RECURSE ${prefix})

run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
foreach(file __init__.py _arguments.py py.typed)
    if(NOT EXISTS ${prefix}/${folder}/vdbcage/${file})
        message(FATAL_ERROR "${file} was not installed")
    endif()
endforeach()
set(ENV{PYTHONPATH} ${prefix}/${folder})
run(${python} -c "
import vdbcage
assert vdbcage.__file__.startswith('${prefix}/'), vdbcage.__file__
assert vdbcage.make_cage(vdbcage.Mesh.read('${model}'), faces=100).check.bounding
")
# Where this Python looks below a prefix is where Debian has /usr/local.
run(${python} -c "
import site
assert '/usr/local/${folder}' in site.getsitepackages(), site.getsitepackages()
")
