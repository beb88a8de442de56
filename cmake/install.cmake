# What `cmake --install` puts where: the program, the library with its public headers for `find_package(stylobate)`, and
# the studies that are ready to run.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/stylobate)

install(DIRECTORY include/stylobate DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(TARGETS stylobate_library EXPORT stylobate ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT stylobate NAMESPACE stylobate:: FILE stylobateTargets.cmake DESTINATION ${package_dir})

configure_package_config_file(cmake/stylobateConfig.cmake.in ${PROJECT_BINARY_DIR}/stylobateConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stylobateConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stylobateConfig.cmake ${PROJECT_BINARY_DIR}/stylobateConfigVersion.cmake
  DESTINATION ${package_dir})

install(TARGETS stylobate DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY studies/inputs DESTINATION ${CMAKE_INSTALL_DATADIR}/stylobate)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/stylobate)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
