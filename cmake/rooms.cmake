# How the rooms of a library are compiled: stylobate_rooms(TARGET). All files of a room together (STYLOBATE_UNITY), but
# those of ALONE folders, whose files have helpers of the same names; and what nearly every file includes, once.
add_library(stylobate_precompiled STATIC ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_link_libraries(stylobate_precompiled PRIVATE stylobate_options fmt::fmt)
target_precompile_headers(stylobate_precompiled PRIVATE
  <fmt/format.h> <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory>
  <optional> <span> <string> <string_view> <utility> <vector>)

# stylobate_unity(TARGET [ALONE folder...])
function(stylobate_unity target)
  cmake_parse_arguments(arg "" "" "ALONE" ${ARGN})
  if(NOT STYLOBATE_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    if(NOT folder IN_LIST arg_ALONE)
      string(MAKE_C_IDENTIFIER ${folder} room)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
    endif()
  endforeach()
endfunction()

# stylobate_measurements(TARGET...): what measures is built by its scripts, by the tests that need it and by the target
# `measurements`, and not with all others: it is a tenth of the time of a build.
add_custom_target(measurements)
function(stylobate_measurements)
  set_target_properties(${ARGN} PROPERTIES EXCLUDE_FROM_ALL ON)
  add_dependencies(measurements ${ARGN})
endfunction()

function(stylobate_rooms target)
  target_precompile_headers(${target} REUSE_FROM stylobate_precompiled)
  stylobate_unity(${target} ${ARGN})
endfunction()
