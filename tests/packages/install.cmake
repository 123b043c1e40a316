# A new Debian with nothing but the packages and what they depend on, made and thrown away by mmdebstrap.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)
set(work ${build}/packages_installed)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/input)

# The sources of this machine that are Debian's, in whichever form it keeps them, and how it reaches them.
file(STRINGS /etc/os-release codename REGEX "^VERSION_CODENAME=")
string(REPLACE "VERSION_CODENAME=" "" codename "${codename}")
execute_process(COMMAND apt-get indextargets --format "deb $(REPO_URI) $(RELEASE) $(COMPONENT)" "Created-By: Packages" "Origin: Debian"
    OUTPUT_VARIABLE sources COMMAND_ERROR_IS_FATAL ANY)
set(known "${sources}")
# sid calls itself by the name of what will be stable next, and has its own after it in another file: "forky/sid".
file(STRINGS /etc/debian_version next_and_own)
string(REPLACE "/" ";" next_and_own "${next_and_own}")
foreach(name IN ITEMS ${codename} ${next_and_own} unstable)
    string(REGEX MATCHALL "deb [^\n]* ${name}(-[a-z]+)? [^\n]*\n" sources "${known}")
    if(sources)
        set(codename ${name})
        break()
    endif()
endforeach()
list(REMOVE_DUPLICATES sources)
if(NOT sources)
    message(FATAL_ERROR "apt knows no source of ${codename}")
endif()
list(JOIN sources "" sources)
file(WRITE ${work}/sources.list "${sources}")
execute_process(COMMAND apt-config dump OUTPUT_VARIABLE settings COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "Acquire::(http|https|Retries|Check)[^\n;]*\"" settings "${settings}")
list(JOIN settings ";\n" settings)
file(WRITE ${work}/apt.conf "${settings};\n")

file(GLOB packages ${build}/packages/*.deb)
file(COPY ${packages} ${source}/data/bishop.obj ${source}/examples
    ${CMAKE_CURRENT_LIST_DIR}/in_new_debian.sh DESTINATION ${work}/input)
# Who is not root makes a system in a name space of its own, or where there is none, as root through sudo.
set(asRoot)
execute_process(COMMAND id -u OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
execute_process(COMMAND unshare --user --map-root-user --mount true RESULT_VARIABLE unshared OUTPUT_QUIET ERROR_QUIET)
if(NOT user EQUAL 0 AND NOT unshared EQUAL 0)
    set(asRoot sudo --non-interactive)
endif()
# mmdebstrap removes what it made, also when a hook fails.
run(${asRoot} ${CMAKE_COMMAND} -E env --unset=LIBRARY_PATH TMPDIR=${work} mmdebstrap --variant=apt --format=null
    --aptopt=${work}/apt.conf --dpkgopt=force-unsafe-io "--customize-hook=copy-in ${work}/input /"
    "--customize-hook=chroot \"$1\" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin sh /input/in_new_debian.sh"
    ${codename} - ${work}/sources.list)
