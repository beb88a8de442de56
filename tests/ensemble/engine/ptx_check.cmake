# What the bits of a GPU rest on, seen in the code that is made for it: every operation is rounded to the nearest, none
# is an approximation, and nothing chooses between two numbers but a selection that is spelled out.
#
#   cmake -DNVCC=... -DHOST=... -DSOURCE_DIR=... -DFLAGS="..." -P ptx_check.cmake
separate_arguments(FLAGS)
set(ptx ${CMAKE_CURRENT_BINARY_DIR}/device_cuda.ptx)
execute_process(
  COMMAND ${NVCC} -ccbin=${HOST} -std=c++20 -O3 -arch=compute_90 -ptx ${FLAGS} -DSTYLOBATE_CUDA -I${SOURCE_DIR}
    ${SOURCE_DIR}/ensemble/planar/device/device_cuda.cu -o ${ptx}
  RESULT_VARIABLE status ERROR_VARIABLE text)
if(status)
  message(FATAL_ERROR "the GPU's code cannot be made: ${text}")
endif()

function(lines_with pattern out)
  file(STRINGS ${ptx} found REGEX "${pattern}")
  list(LENGTH found count)
  set(${out} ${count} PARENT_SCOPE)
endfunction()

# something is looked at at all
foreach(bits 64 32)
  lines_with("[ \t]fma\\.rn\\.f${bits}" fused)
  lines_with("[ \t]mul\\.rn\\.f${bits}" products)
  lines_with("[ \t]div\\.rn\\.f${bits}" quotients)
  lines_with("[ \t]sqrt\\.rn\\.f${bits}" roots)
  foreach(kind fused products quotients roots)
    if(${kind} EQUAL 0)
      message(FATAL_ERROR "no ${kind} of ${bits} bits are found: it is not the step that was looked at")
    endif()
  endforeach()
  message(STATUS "${bits} bits: ${fused} fused, ${products} products, ${quotients} quotients, ${roots} roots, all rounded to the nearest")
endforeach()
# (.ftz and .approx: less than IEEE 754; mul.f64 and add.f64 without a rounding may be fused by the assembler)
foreach(pattern "\\.ftz" "\\.approx" "[ \t](mul|add|sub)\\.f(64|32)" "[ \t](min|max)\\.f(64|32)")
  lines_with("${pattern}" count)
  if(count GREATER 0)
    message(FATAL_ERROR "${count} lines of ${ptx} have ${pattern}: the GPU would not have the processor's bits")
  endif()
endforeach()
