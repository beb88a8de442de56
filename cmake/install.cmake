# What `cmake --install` puts where: the program, the libraries with their headers for `find_package(stylobate)`, and
# the studies that are ready to run.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/stylobate)

# Headers are included as in the sources: "ensemble/model/study.hpp".
target_include_directories(stylobate_options INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stylobate>)
foreach(part kernels ensemble io)
  install(DIRECTORY ${part} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stylobate
    FILES_MATCHING PATTERN "*.hpp"
    PATTERN "hdf5.hpp" EXCLUDE PATTERN "result_file.hpp" EXCLUDE
    PATTERN "result_sensitivity.hpp" EXCLUDE PATTERN "result_rare.hpp" EXCLUDE) # the insides of the store, which need HDF5's headers
endforeach()

foreach(part options kernels ensemble io)
  set_target_properties(stylobate_${part} PROPERTIES EXPORT_NAME ${part})
  install(TARGETS stylobate_${part} EXPORT stylobate DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
install(EXPORT stylobate NAMESPACE stylobate:: FILE stylobateTargets.cmake DESTINATION ${package_dir})

configure_package_config_file(cmake/stylobateConfig.cmake.in ${PROJECT_BINARY_DIR}/stylobateConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stylobateConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stylobateConfig.cmake ${PROJECT_BINARY_DIR}/stylobateConfigVersion.cmake
  DESTINATION ${package_dir})

install(TARGETS stylobate DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY studies/inputs DESTINATION ${CMAKE_INSTALL_DATADIR}/stylobate)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
