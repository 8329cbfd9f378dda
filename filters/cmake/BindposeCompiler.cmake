# The language standard, the warnings for Bindpose's targets, ccache if it is installed, and the options of a portable
# Release build.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(BINDPOSE_CCACHE ccache)
mark_as_advanced(BINDPOSE_CCACHE)
if(BINDPOSE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${BINDPOSE_CCACHE}")
  set(CMAKE_C_COMPILER_LAUNCHER "${BINDPOSE_CCACHE}")
endif()

# Results must not depend on the machine: no -march=native, and no contraction of a*b+c into fused operations. The
# iterations that compute poses are an exception (bindpose_fused in filters/core/CMakeLists.txt). Fused operations make
# them a fifth faster.
add_compile_options(-ffp-contract=off)

# bindpose_warnings(TARGET): enable the warnings that all targets of Bindpose use.
function(bindpose_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wshadow -Wno-sign-compare -Wno-unused-parameter)
endfunction()
