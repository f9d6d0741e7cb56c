# `cmake --install` and what find_package(insonify) finds afterwards.
install(TARGETS insonify EXPORT insonifyTargets FILE_SET HEADERS)
install(EXPORT insonifyTargets NAMESPACE insonify:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/insonify)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/insonifyConfig.cmake.in
  ${PROJECT_BINARY_DIR}/insonifyConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/insonify)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/insonifyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/insonifyConfig.cmake ${PROJECT_BINARY_DIR}/insonifyConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/insonify)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/insonify)
