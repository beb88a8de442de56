# Runs between the installation into a folder for each component and the making of the packages: moves, compresses and
# adds what Debian's policy asks for.
set(packaging ${CPACK_STYLOBATE_SOURCE_DIR}/packaging/debian)
cmake_policy(VERSION 3.25)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH, if that is set

function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

include(${CPACK_STYLOBATE_SOURCE_DIR}/cmake/third_party.cmake)
third_party_notices(third_party)

foreach(component ${CPACK_COMPONENTS_ALL})
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(doc ${root}/share/doc/${name})

  if(component STREQUAL "program")
    file(REMOVE ${doc}/LICENSE ${doc}/README.md ${doc}/CITATION.cff) # in `copyright`; the pages are another package
    file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)
    compress(${doc}/changelog)
    file(GLOB pages ${root}/share/man/man1/*.1)
    foreach(page ${pages})
      compress(${page})
    endforeach()
  elseif(component STREQUAL "documentation")
    file(REMOVE ${root}/share/doc/stylobate/LICENSE)
  elseif(component STREQUAL "python")
    file(MAKE_DIRECTORY ${root}/lib/python3)
    file(GLOB site ${root}/lib/python3.*)
    file(RENAME ${site}/site-packages ${root}/lib/python3/dist-packages)
    file(REMOVE_RECURSE ${site})
    file(WRITE ${root}/lib/python3/dist-packages/stylobate-${CPACK_PACKAGE_VERSION}.dist-info/METADATA
      "Metadata-Version: 2.1\nName: stylobate\nVersion: ${CPACK_PACKAGE_VERSION}\nRequires-Dist: numpy\n")
    file(COPY ${CPACK_STYLOBATE_SOURCE_DIR}/python/examples DESTINATION ${doc})
  endif()

  file(MAKE_DIRECTORY ${doc})
  configure_file(${packaging}/copyright ${doc}/copyright COPYONLY)
  configure_file(${packaging}/changelog.in ${doc}/changelog.Debian @ONLY)
  compress(${doc}/changelog.Debian)
  if(component MATCHES "program|development|python")
    file(WRITE ${doc}/third_party "${third_party}")
    compress(${doc}/third_party)
  endif()
endforeach()
