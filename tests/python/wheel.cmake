# pip makes the wheel, from a copy of the sources, without network. Installed in an environment of its own it runs the
# example of README.md.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
set(work ${build}/python_wheel) # build/wheel of the copy is as deep as this build: a compiler cache sees the same paths
set(copy ${work}/source)
file(REMOVE_RECURSE ${work}/wheels ${work}/venv)

set(sources CMakeLists.txt LICENSE README.md cmake pyproject.toml setup.py shaders tools vdbcage)
file(GLOB old ${copy}/*)
list(FILTER old EXCLUDE REGEX "/build$")
if(old)
    file(REMOVE_RECURSE ${old})
endif()
list(TRANSFORM sources PREPEND ${source}/ OUTPUT_VARIABLE paths)
file(COPY ${paths} DESTINATION ${copy})
unset(ENV{PYTHONPATH}) # of the module in the build
unset(ENV{PYTHONWARNINGS}) # those of pip and setuptools are not ours
set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${launcher}")
set(ENV{CMAKE_ARGS} "-DCMAKE_CXX_COMPILER=${compiler} -DVDBCAGE_WARNINGS_AS_ERRORS=${strict}")
run(${python} -m pip wheel --no-build-isolation --no-index --wheel-dir ${work}/wheels ${copy})
file(GLOB left RELATIVE ${copy} ${copy}/* ${copy}/tools/python/*.egg-info)
list(REMOVE_ITEM left ${sources} build)
if(left)
    message(FATAL_ERROR "pip left ${left} in the sources; all it makes belongs in build/")
endif()

file(STRINGS ${source}/vdbcage/core/version.h version REGEX "define VDBCAGE_VERSION")
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" version "${version}")
file(GLOB wheel ${work}/wheels/*)
if(NOT wheel MATCHES "/vdbcage-${version}-cp3[0-9]+-cp3[0-9]+-linux_[a-z0-9_]+\\.whl$")
    message(FATAL_ERROR "the wheel is not of ${version} and this Python: ${wheel}")
endif()

run(${python} -m venv --system-site-packages --without-pip ${work}/venv)
run(${python} -m pip --python ${work}/venv/bin/python install --no-index --no-deps ${wheel})
set(installed ${work}/venv/lib/python3.*/site-packages)
foreach(file vdbcage/py.typed vdbcage-${version}.dist-info/LICENSE)
    string(REPLACE .dist-info/ .dist-info/licenses/ newer ${file}) # where later versions of setuptools put licences
    file(GLOB found ${installed}/${file} ${installed}/${newer})
    if(NOT found)
        message(FATAL_ERROR "${file} was not installed")
    endif()
endforeach()
run(${work}/venv/bin/python -c "
import vdbcage
assert vdbcage.__file__.startswith('${work}/venv/'), vdbcage.__file__
assert vdbcage.__version__ == '${version}', vdbcage.__version__
")
run(${CMAKE_COMMAND} -E chdir ${source}/tests/python
    ${work}/venv/bin/python -m unittest test_text.TextTest.test_the_example_of_the_readme_runs)
