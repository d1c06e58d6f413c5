include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/carom)

if(BUILD_SHARED_LIBS)
  # A minor version may change the API, and so has a name of its own. What is installed finds the rest beside it, wherever
  # that is.
  set(libraries carom)
  if(CAROM_LAB)
    list(APPEND libraries carom_lab)
  endif()
  set_target_properties(${libraries} PROPERTIES VERSION ${PROJECT_VERSION} INSTALL_RPATH $ORIGIN
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(TARGET carom_app)
    file(RELATIVE_PATH to_libraries ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
    set_target_properties(carom_app PROPERTIES INSTALL_RPATH $ORIGIN/${to_libraries})
  endif()
endif()

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
