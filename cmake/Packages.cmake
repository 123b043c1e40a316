# `cpack` makes Debian packages of what cmake/Install.cmake installs, one of each component. Files that a package needs
# by Debian's policy, and no other installation has, are made from cmake/debian/.
if(NOT BUILD_SHARED_LIBS OR NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    message(FATAL_ERROR "VDBCAGE_DEBIAN_PACKAGES needs BUILD_SHARED_LIBS=ON and CMAKE_INSTALL_PREFIX=/usr, as in "
        "`cmake --preset packages`; they are '${BUILD_SHARED_LIBS}' and '${CMAKE_INSTALL_PREFIX}'")
endif()
if(NOT VDBCAGE_BUILD_TOOLS OR NOT TARGET vdbcage_view OR NOT TARGET vdbcage_python)
    message(FATAL_ERROR
        "VDBCAGE_DEBIAN_PACKAGES needs VDBCAGE_BUILD_TOOLS, VDBCAGE_BUILD_VIEW and VDBCAGE_BUILD_PYTHON to be ON")
endif()

set(made ${PROJECT_BINARY_DIR}/debian)
set(package_library libvdbcage${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(package_development libvdbcage-dev)
set(package_programs vdbcage)
set(package_python python3-vdbcage)

# Who makes the packages, as Debian's own tools are told.
set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if("$ENV{DEBFULLNAME}" STREQUAL "" OR "$ENV{DEBEMAIL}" STREQUAL "")
    set(maintainer "The makers of vdbcage <vdbcage@packages.invalid>")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vdbcage)
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# Whatever the umask: new users of Debian 13 have 002.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL library development programs python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SOURCE vdbcage)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0vdbcage1) # older than Debian's own packages would be
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What programs are linked to comes from dpkg-shlibdeps. It does not know our own library, which is not installed.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/vdbcage)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
foreach(component development programs python)
    string(TOUPPER ${component} upper)
    set(CPACK_COMPONENT_${upper}_DEPENDS library)
endforeach()

# Lines of descriptions have at most 79 letters.
if(VDBCAGE_WITH_CGAL_GPL)
    set(licence "Apache-2.0 and GPL-3+")
    set(gplParagraph "
License: GPL-3+
 On Debian systems the GNU General Public License, version 3, is in
 /usr/share/common-licenses/GPL-3.
")
    set(gpl "This build has `repair` and the voxelizer `cgal`, which are made from GPL
packages of CGAL: as a whole it is under the GPL, version 3 or later.")
else()
    set(licence "Apache-2.0")
    set(gplParagraph "")
    set(gpl "This build leaves out `repair` and the voxelizer `cgal`, which would need
GPL packages of CGAL.")
endif()
set(purpose "A cage is a coarse closed mesh around a detailed model. Moving the cage
deforms the model. vdbcage makes cages of any mesh, also open,
self-intersecting or in many parts. They are tight, and certified by exact
predicates to bound the whole model.")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # it would stand above each of these
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "coarse, tight, strictly bounding cages for any model
${purpose}

This package has the shared library. Without a display, OpenGL for voxels and
pictures needs one of the recommended drivers.
${gpl}")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "bounding cages for any model - development files
${purpose}

This package has the headers, and files by which CMake and pkg-config find the
library.
${gpl}")
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "bounding cages for any model - command and window
${purpose}

This package has the command vdbcage, the window vdbcage-view, and an add-on
for Blender, which is /usr/share/vdbcage/vdbcage_cage.zip.
${gpl}")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "bounding cages for any model - Python module
${purpose}

This package has the module vdbcage for Python 3, with NumPy arrays.
${gpl}")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)

# OpenGL without a display is loaded when it is first used.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libegl1, libosmesa6")
# What packages of others that are linked to the library depend on. CPack would take the Python module for one too.
file(CONFIGURE OUTPUT ${made}/shlibs CONTENT
    "libvdbcage ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} ${package_library} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers ${made}/shlibs)
# Debian's OpenVDB says to CMake that Boost and zlib are needed, but its package does not.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS libopenvdb-dev libtbb-dev libboost-iostreams-dev zlib1g-dev)
list(JOIN CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
# The module is of one minor version of Python.
get_directory_property(python DIRECTORY tools/python DEFINITION Python3_VERSION_MINOR)
math(EXPR nextPython "${python} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${python}), python3 (<< 3.${nextPython}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)

# Compressed without names and times, so that the same sources make the same bytes.
function(compressed input output)
    execute_process(COMMAND gzip -9nc ${input} OUTPUT_FILE ${output} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md)
string(REPLACE "\n" "\n " gplIndented "${gpl}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # or of SOURCE_DATE_EPOCH
configure_file(cmake/debian/changelog.in ${made}/changelog @ONLY)
configure_file(cmake/debian/copyright.in ${made}/copyright @ONLY)
compressed(${made}/changelog ${made}/changelog.Debian.gz)
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${made}/changelog.gz)

# Licences of what is compiled into our files, as Debian states them: headers, and libraries that are linked statically.
set(builtWith_library libcgal-dev libopenmesh-dev libopenvdb-dev libtbb-dev)
set(builtWith_programs ${builtWith_library} libcli11-dev nlohmann-json3-dev libimgui-dev fonts-inter)
set(builtWith_python ${builtWith_library} nlohmann-json3-dev pybind11-dev)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} upper)
    set(package ${package_${component}})
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
    set(documents ${CMAKE_INSTALL_DATADIR}/doc/${package})
    install(FILES ${made}/copyright ${made}/changelog.gz ${made}/changelog.Debian.gz
        DESTINATION ${documents} COMPONENT ${component})
    foreach(other IN LISTS builtWith_${component})
        if(EXISTS /usr/share/doc/${other}/copyright)
            install(FILES /usr/share/doc/${other}/copyright DESTINATION ${documents}/built-with/${other}
                COMPONENT ${component})
        endif()
    endforeach()
    set(overrides cmake/debian/${component}.lintian-overrides)
    if(EXISTS ${PROJECT_SOURCE_DIR}/${overrides})
        install(FILES ${overrides} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${package}
            COMPONENT ${component})
    endif()
endforeach()
include(CPack)
