# `cmake --install` of the library, its public headers and the programs; found again by find_package(vdbcage CONFIG).
include(CMakePackageConfigHelpers)

set(packageDir ${CMAKE_INSTALL_LIBDIR}/cmake/vdbcage)
install(TARGETS vdbcage EXPORT vdbcageTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# A header in vdbcage/ROOM/ is public; those in detail/, geometry/, gl/ and mesh/io/ are not.
install(DIRECTORY vdbcage DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h" PATTERN detail EXCLUDE
    PATTERN geometry EXCLUDE PATTERN gl EXCLUDE PATTERN io EXCLUDE)
install(EXPORT vdbcageTargets NAMESPACE vdbcage:: DESTINATION ${packageDir})
configure_package_config_file(cmake/vdbcageConfig.cmake.in ${PROJECT_BINARY_DIR}/vdbcageConfig.cmake
    INSTALL_DESTINATION ${packageDir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vdbcageConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vdbcageConfig.cmake ${PROJECT_BINARY_DIR}/vdbcageConfigVersion.cmake
    cmake/VdbcageDependencies.cmake DESTINATION ${packageDir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vdbcage)
if(VDBCAGE_BUILD_TOOLS)
    install(TARGETS vdbcage_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    if(TARGET vdbcage_view)
        install(TARGETS vdbcage_view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
endif()
