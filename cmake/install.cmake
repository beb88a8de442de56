# What `cmake --install` puts where: the program with its manual page, the completion of bash and the studies that are
# ready to run (component program); the library with its public headers for `find_package(stylobate)` and the examples
# (development); the Python module (python, see ../python). The pages are a component that only packages have.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/stylobate)

install(DIRECTORY include/stylobate DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inc")
install(TARGETS stylobate_library EXPORT stylobate ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT stylobate NAMESPACE stylobate:: FILE stylobateTargets.cmake DESTINATION ${package_dir}
  COMPONENT development)

configure_package_config_file(cmake/stylobateConfig.cmake.in ${PROJECT_BINARY_DIR}/stylobateConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stylobateConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stylobateConfig.cmake ${PROJECT_BINARY_DIR}/stylobateConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT development)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/stylobate COMPONENT development)

install(TARGETS stylobate DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY studies/inputs DESTINATION ${CMAKE_INSTALL_DATADIR}/stylobate COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
if(NOT CMAKE_CROSSCOMPILING) # the build has asked the program for them
  install(FILES ${PROJECT_BINARY_DIR}/studies/stylobate.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${PROJECT_BINARY_DIR}/studies/stylobate.bash RENAME stylobate
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
endif()

# The pages in the folders that they have here, with their pictures, and what they link to: stylobate_page_files(OUT).
function(stylobate_page_files out)
  file(GLOB pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} *.md)
  foreach(room bench docs ensemble examples io kernels library packaging python studies tests)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${room}/*.md)
    list(APPEND pages ${found})
  endforeach()
  set(files ${pages})
  foreach(page ${pages})
    cmake_path(GET page PARENT_PATH folder)
    file(READ ${page} text)
    string(REPLACE "](" "\n<" text "${text}") # brackets would hold elements of a list together
    string(REGEX MATCHALL "\n<[^]);# \n]+" links "${text}")
    foreach(link ${links})
      string(SUBSTRING ${link} 2 -1 link)
      cmake_path(APPEND folder ${link} OUTPUT_VARIABLE target)
      cmake_path(NORMAL_PATH target)
      if(EXISTS ${PROJECT_SOURCE_DIR}/${target} AND NOT IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${target}
         AND NOT target MATCHES "^\\.\\./")
        list(APPEND files ${target})
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES files)
  set(${out} ${files} PARENT_SCOPE)
endfunction()

stylobate_page_files(page_files)
foreach(file ${page_files})
  cmake_path(GET file PARENT_PATH folder)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT documentation EXCLUDE_FROM_ALL)
endforeach()
