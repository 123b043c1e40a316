# `cmake --install` of the library, its public headers and the programs; found again by find_package(vdbcage CONFIG),
# or by pkg-config.
# Each component is one package of cmake/Packages.cmake: library, development, programs, python. LICENSE is in none of
# them: a package says it in its own file.
include(CMakePackageConfigHelpers)

set(packageDir ${CMAKE_INSTALL_LIBDIR}/cmake/vdbcage)
install(TARGETS vdbcage EXPORT vdbcageTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
# A header in vdbcage/ROOM/ is public; those in detail/, geometry/, gl/ and mesh/io/ are not.
install(DIRECTORY vdbcage DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
    FILES_MATCHING PATTERN "*.h" PATTERN detail EXCLUDE
    PATTERN geometry EXCLUDE PATTERN gl EXCLUDE PATTERN io EXCLUDE)
install(EXPORT vdbcageTargets NAMESPACE vdbcage:: DESTINATION ${packageDir} COMPONENT development)
set(requiresOfPkgConfig tbb)
if(TARGET Imath::Imath) # OpenVDB's headers include it
    string(APPEND requiresOfPkgConfig " Imath")
endif()
# A shared library is linked to the rest already: whoever uses it need not have that rest's headers.
if(BUILD_SHARED_LIBS)
    set(scopeOfDependencies "")
    set(privateOfPkgConfig "")
else()
    set(scopeOfDependencies ALL)
    set(qhull qhull_r)
    if(NOT TARGET Qhull::qhull_r)
        set(qhull qhullstatic_r)
    endif()
    set(privateOfPkgConfig
        "Requires.private: ${qhull} zlib blosc mpfr gmp\nLibs.private: -lOpenMeshCore -l${CMAKE_DL_LIBS}\n")
endif()
configure_package_config_file(cmake/vdbcageConfig.cmake.in ${PROJECT_BINARY_DIR}/vdbcageConfig.cmake
    INSTALL_DESTINATION ${packageDir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vdbcageConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vdbcageConfig.cmake ${PROJECT_BINARY_DIR}/vdbcageConfigVersion.cmake
    cmake/VdbcageDependencies.cmake DESTINATION ${packageDir} COMPONENT development)
file(RELATIVE_PATH pathToPrefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" pathToPrefix ${pathToPrefix})
configure_file(cmake/vdbcage.pc.in ${PROJECT_BINARY_DIR}/vdbcage.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/vdbcage.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vdbcage COMPONENT licence)

# vdbcage_install_beside_library(TARGET FOLDER): what is installed in FOLDER below the prefix finds the shared library
# from there, whatever the prefix is. In packages the linker knows where it is.
function(vdbcage_install_beside_library target folder)
    if(BUILD_SHARED_LIBS AND NOT VDBCAGE_DEBIAN_PACKAGES)
        file(RELATIVE_PATH toLibrary /${folder} /${CMAKE_INSTALL_LIBDIR})
        set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${toLibrary}")
    endif()
endfunction()
foreach(program vdbcage_cli vdbcage_view)
    if(TARGET ${program})
        vdbcage_install_beside_library(${program} ${CMAKE_INSTALL_BINDIR})
        install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
    endif()
endforeach()
if(TARGET vdbcage_cli)
    # docs/ has folders; here all pages and pictures are in one, where links and paths lead to each other too.
    set(documents ${PROJECT_BINARY_DIR}/documents)
    file(REMOVE_RECURSE ${documents})
    file(GLOB pages RELATIVE ${PROJECT_SOURCE_DIR}
        README.md docs/*.md docs/*/*.md docs/*/*.json docs/*/*.view docs/*/*.param)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${pages})
    foreach(page IN LISTS pages)
        file(READ ${page} text)
        if(page MATCHES "^docs/[a-z]+/")
            string(REPLACE "](../" "](" text "${text}")
        endif()
        string(REGEX REPLACE "(docs/|\\]\\()(user|dev|pictures)/" "\\1" text "${text}")
        string(REGEX REPLACE "^docs/[a-z]+/" "docs/" page ${page})
        file(WRITE ${documents}/${page} "${text}")
    endforeach()
    install(DIRECTORY ${documents}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vdbcage COMPONENT programs)
    install(DIRECTORY docs/pictures/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vdbcage/docs COMPONENT programs
        FILES_MATCHING PATTERN "*.png")
endif()
if(TARGET vdbcage_cli AND NOT CMAKE_CROSSCOMPILING) # the programs print their manual pages
    set(manuals ${PROJECT_BINARY_DIR}/manuals)
    set(window "")
    if(TARGET vdbcage_view)
        set(window $<TARGET_FILE:vdbcage_view>)
    endif()
    add_custom_command(OUTPUT ${manuals}.stamp
        COMMAND ${CMAKE_COMMAND} -DCOMMAND=$<TARGET_FILE:vdbcage_cli> -DWINDOW=${window} -DFOLDER=${manuals}
            -DDEBIAN=${VDBCAGE_DEBIAN_PACKAGES} -P ${PROJECT_SOURCE_DIR}/cmake/WriteManuals.cmake
        COMMAND ${CMAKE_COMMAND} -E touch ${manuals}.stamp
        DEPENDS vdbcage_cli $<TARGET_NAME_IF_EXISTS:vdbcage_view> ${PROJECT_SOURCE_DIR}/cmake/WriteManuals.cmake
        COMMENT "Printing manual pages and completions" VERBATIM)
    add_custom_target(vdbcage_manuals ALL DEPENDS ${manuals}.stamp)
    install(DIRECTORY ${manuals}/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT programs)
endif()
if(TARGET vdbcage_blender)
    get_target_property(addon vdbcage_blender ADDON)
    install(FILES ${addon} DESTINATION ${CMAKE_INSTALL_DATADIR}/vdbcage COMPONENT programs)
endif()
if(TARGET vdbcage_python)
    vdbcage_install_beside_library(vdbcage_python ${VDBCAGE_PYTHON_DIR}/vdbcage)
    install(TARGETS vdbcage_python LIBRARY DESTINATION ${VDBCAGE_PYTHON_DIR}/vdbcage COMPONENT python)
    get_target_property(texts vdbcage_python TEXTS)
    install(FILES ${texts} DESTINATION ${VDBCAGE_PYTHON_DIR}/vdbcage COMPONENT python)
endif()
