# Installs the build into an empty folder, builds the examples against it alone, and runs them and the program. What they
# print stays in install_check/, for tests/library.
#   cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DGENERATOR=... -DCOMPILER=... -DFLAGS=... -DBUILD_TYPE=... -P install_check.cmake
set(work ${BUILD_DIR}/install_check)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

# run(COMMAND...), what it prints in `output`
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    string(JOIN " " command ${ARGV})
    message(FATAL_ERROR "${command}\ngave ${status}:\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${prefix}/bin/stylobate --version)
file(COPY ${SOURCE_DIR}/examples DESTINATION ${work}) # away from the sources
run(${CMAKE_COMMAND} -S ${work}/examples -B ${work}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS} -Werror" -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
run(${CMAKE_COMMAND} --build ${work}/build)
set(study ${prefix}/share/stylobate/inputs/small_scale_column.toml)
run(${work}/build/surface ${study})
file(WRITE ${work}/surface.txt "${output}")
run(${work}/build/custom_excitation)
file(WRITE ${work}/custom_excitation.txt "${output}")
run(${work}/build/follow ${study} ${work}/follow.svg)
file(WRITE ${work}/follow.txt "${output}")

# Nothing that is installed may look back into the build or the sources, and no header needs more than the standard's.
file(GLOB_RECURSE texts ${prefix}/*.cmake ${prefix}/*.hpp)
foreach(file ${texts})
  file(READ ${file} text)
  foreach(folder ${BUILD_DIR} ${SOURCE_DIR})
    string(FIND "${text}" "${folder}/" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${file} names ${folder}")
    endif()
  endforeach()
endforeach()
file(GLOB_RECURSE headers ${prefix}/include/*)
foreach(header ${headers})
  file(READ ${header} text)
  string(REGEX MATCHALL "#include [^\n]*" includes "${text}")
  foreach(include ${includes})
    if(NOT include MATCHES "^#include (<[a-z_]+>|\"stylobate/[a-z_]+\\.hpp\")$")
      message(FATAL_ERROR "${header}: ${include}")
    endif()
  endforeach()
endforeach()
