# `cmake --install`, and what find_package(insonify) finds afterwards. Components: the library with what it reads while it
# runs, what is needed to build against it, and the command line with the scenes. cmake/Package.cmake makes one package of each.
install(TARGETS insonify EXPORT insonifyTargets
  LIBRARY COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ ${PROJECT_BINARY_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development FILES_MATCHING PATTERN *.h)
if(TARGET insonify_sdf)
  install(TARGETS insonify_sdf LIBRARY COMPONENT library NAMELINK_SKIP)
endif()
install(TARGETS insonify_reader RUNTIME DESTINATION ${reader_folder} COMPONENT library)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/insonify COMPONENT library)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/licences DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/insonify COMPONENT library)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/insonify)
install(EXPORT insonifyTargets NAMESPACE insonify:: DESTINATION ${config_folder} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/insonifyConfig.cmake.in
  ${PROJECT_BINARY_DIR}/insonifyConfig.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/insonifyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/insonifyConfig.cmake ${PROJECT_BINARY_DIR}/insonifyConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindZstd.cmake ${PROJECT_SOURCE_DIR}/cmake/FindMinizip.cmake DESTINATION ${config_folder} COMPONENT development)
# For builds that ask pkg-config, as Rock's do. A static library's users need CMake, which finds what it uses.
if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/insonify.pc.in ${PROJECT_BINARY_DIR}/insonify.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/insonify.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/insonify COMPONENT development
  PATTERN __pycache__ EXCLUDE)

if(INSONIFY_BUILD_APPS)
  install(TARGETS insonify_cli COMPONENT tools)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT tools
    REGEX "/share/insonify$" EXCLUDE)  # Links to the sources, for the build tree.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/foxglove DESTINATION ${CMAKE_INSTALL_DATADIR}/insonify COMPONENT tools)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/insonify COMPONENT tools
    PATTERN make EXCLUDE)
endif()
