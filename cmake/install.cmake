include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(DIRECTORY include/carom DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(targets carom)
if(CAROM_LAB)
  list(APPEND targets carom_lab)
endif()
install(TARGETS ${targets} EXPORT caromTargets)
install(EXPORT caromTargets NAMESPACE carom:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
configure_package_config_file(cmake/caromConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/caromConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/caromConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/caromConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/caromConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
