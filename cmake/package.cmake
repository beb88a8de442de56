# Packages for Debian (scripts/package.sh). Four, because each has users who need none of the others, and their
# dependencies differ: the program, the library, the Python module, the pages with their pictures (larger than all else).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stylobate)
set(CPACK_PACKAGE_VENDOR "The Stylobate developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
# There is no address to write to.
set(CPACK_PACKAGE_CONTACT "The Stylobate developers <developers@stylobate.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_COMPONENTS_ALL program development documentation)
if(TARGET stylobate_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# stylobate_package(COMPONENT NAME SECTION DESCRIPTION)
macro(stylobate_package component name section description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}")
  set(CPACK_DEBIAN_${upper}_FILE_NAME DEB-DEFAULT)
endmacro()

stylobate_package(program stylobate science
"probability that ancient multi-drum columns collapse under shaking
Computes the probability that an ancient multi-drum column or colonnade
collapses under given base shaking, with a confidence interval, from tens of
thousands of slightly different realizations, several at a time in the
registers of the processor. Pages for a browser, pictures, tables; fragility
curves, sensitivity, rare events; calibration and diagnosis by measured data.
With studies that are ready to run, in /usr/share/stylobate/inputs.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# It loads librsvg when it draws a picture as PNG or PDF, and starts ffmpeg for films; all else it does by itself.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "librsvg2-2, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, bash-completion, stylobate-doc, python3-stylobate")

stylobate_package(development libstylobate-dev libdevel
"C++ library of ensembles of multi-drum columns
The library behind the program stylobate, for other C++20 programs: a static
library, twelve headers that need the standard's only, a CMake package
(find_package(stylobate)), and five programs as examples.")
# What the static library is linked with (cmake/stylobateConfig.cmake.in).
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libtbb-dev, libhdf5-dev, libeigen3-dev, libfmt-dev, zlib1g-dev, libpugixml-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, stylobate-doc")

stylobate_package(documentation stylobate-doc doc
"pages and pictures of stylobate
What stylobate computes, how and how well: the reference of study files, the
theory, the comparison with exact solutions and with measured data.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

stylobate_package(python python3-stylobate python
"ensembles of multi-drum columns in Python
The Python module stylobate: runs studies and reads results, with the bits of
the program stylobate; xarray, pandas and Matplotlib where they are asked for.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(TARGET stylobate_python)
  string(REGEX MATCH "python3\\.([0-9]+)" ignored "${STYLOBATE_PYTHON_DIR}") # the module is of one version of Python
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-xarray, python3-pandas, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "stylobate, stylobate-doc")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/packaging/debian/postinst;${PROJECT_SOURCE_DIR}/packaging/debian/prerm")

# What is known only when the packages are made: the version with the commit; and how Debian wants files to lie.
set(STYLOBATE_PROGRAM ${PROJECT_BINARY_DIR}/studies/stylobate)
configure_file(cmake/package_version.cmake.in ${PROJECT_BINARY_DIR}/package_version.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/package_version.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_layout.cmake)

include(CPack)
