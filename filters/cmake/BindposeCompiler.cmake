# Language, warnings for our own targets, ccache when there, and how a portable Release is compiled.
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

# Deterministic across machines: no -march=native, no contraction of a*b+c into fused operations, but for the iterations
# of pose time (bindpose_fused in filters/core/CMakeLists.txt), which they make a fifth faster.
add_compile_options(-ffp-contract=off)

# bindpose_warnings(TARGET): the warnings every target of ours is compiled with.
function(bindpose_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wshadow -Wno-sign-compare -Wno-unused-parameter)
endfunction()
