include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/carom)

install(DIRECTORY include/carom DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS carom EXPORT caromTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT caromTargets NAMESPACE carom:: DESTINATION ${package})
if(CAROM_LAB)
  install(TARGETS carom_lab EXPORT caromLabTargets)
  install(EXPORT caromLabTargets NAMESPACE carom:: DESTINATION ${package})
endif()

# Side by side as here, so that the pages find the scenes.
set(data ${CMAKE_INSTALL_DATADIR}/carom)
install(DIRECTORY docs scenes DESTINATION ${data} FILES_MATCHING REGEX "\\.(md|png|json)$")
install(FILES docs/reference/scene.schema.json LICENSE THIRD-PARTY.md CONTRIBUTING.md DESTINATION ${data})
install(FILES tests/reference/truth.json DESTINATION ${data}/tests/reference)

configure_package_config_file(cmake/caromConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/caromConfig.cmake
                              INSTALL_DESTINATION ${package} PATH_VARS data)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/caromConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/caromConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/caromConfigVersion.cmake
        DESTINATION ${package})
