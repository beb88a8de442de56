# What a wheel for other machines is made of (scripts/package.sh --wheel): the Python module and the program in
# BUILD/wheel, linked once more from the objects of this build, with HDF5 inside and without MPI.
#
# HDF5's shared library is not copied, as python/build_backend.py does with the others: it would be a second one beside
# that of h5py, and it needs libcurl with twenty more for files in the cloud.
if(NOT TARGET stylobate_python OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  return()
endif()
find_library(STYLOBATE_STATIC_HDF5 NAMES libhdf5_serial.a libhdf5.a PATH_SUFFIXES hdf5/serial)
find_library(STYLOBATE_STATIC_SZ libsz.a) # a filter of HDF5, with the library below
find_library(STYLOBATE_STATIC_AEC libaec.a)
mark_as_advanced(STYLOBATE_STATIC_HDF5 STYLOBATE_STATIC_SZ STYLOBATE_STATIC_AEC)
if(NOT STYLOBATE_STATIC_HDF5 OR NOT STYLOBATE_STATIC_SZ OR NOT STYLOBATE_STATIC_AEC)
  message(STATUS "wheel for other machines: not made, libhdf5.a, libsz.a or libaec.a is missing")
  return()
endif()

add_library(stylobate_wheel_module MODULE EXCLUDE_FROM_ALL
  $<TARGET_OBJECTS:stylobate_python> ${CMAKE_CURRENT_LIST_DIR}/static_hdf5.c)
get_target_property(suffix stylobate_python SUFFIX)
set_target_properties(stylobate_wheel_module PROPERTIES PREFIX "" OUTPUT_NAME _core SUFFIX "${suffix}"
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/wheel)
target_link_options(stylobate_wheel_module PRIVATE -Wl,--wrap=stdout,--wrap=stderr) # static_hdf5.c says why

# the objects of the program but the one that calls MPI, which is compiled here as without it
add_executable(stylobate_wheel_program EXCLUDE_FROM_ALL
  "$<FILTER:$<TARGET_OBJECTS:stylobate>,EXCLUDE,mpi_ranks>" ${PROJECT_SOURCE_DIR}/studies/cluster/mpi_ranks.cpp)
set_target_properties(stylobate_wheel_program PROPERTIES OUTPUT_NAME stylobate
  RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/wheel)

get_target_property(libraries stylobate_library LINK_LIBRARIES)
list(REMOVE_ITEM libraries ${HDF5_C_LIBRARIES})
foreach(target stylobate_wheel_module stylobate_wheel_program)
  add_dependencies(${target} stylobate_library)
  target_link_libraries(${target} PRIVATE stylobate_options $<TARGET_FILE:stylobate_library> ${libraries}
    ${STYLOBATE_STATIC_HDF5} ${STYLOBATE_STATIC_SZ} ${STYLOBATE_STATIC_AEC} ZLIB::ZLIB ${CMAKE_DL_LIBS})
  # HDF5's names are hidden: another HDF5 in the process takes none of them, and gives none
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL -Wl,--gc-sections -s)
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX SKIP_BUILD_RPATH ON)
endforeach()
add_custom_target(stylobate_wheel DEPENDS stylobate_wheel_module stylobate_wheel_program)
