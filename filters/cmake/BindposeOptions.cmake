# bindpose_generate(OUTPUT KIND [INPUT…]): add a rule that generates a file from the descriptions of options. OUTPUT is
# relative to the current binary directory; KIND and INPUT are arguments of filters/options/generate.py.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that generates code, and for which the package is built")
endif()
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)

get_filename_component(bindpose_source "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
set(bindpose_options "${bindpose_source}/filters/options")
file(GLOB bindpose_descriptions CONFIGURE_DEPENDS
  "${bindpose_options}/*.py" "${bindpose_source}/filters/core/*/*.options.json")
list(APPEND bindpose_descriptions "${bindpose_source}/viewer/cli/verbs.json")

function(bindpose_generate output kind)
  cmake_path(ABSOLUTE_PATH output BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" OUTPUT_VARIABLE path)
  add_custom_command(OUTPUT "${path}"
    COMMAND "${Python3_EXECUTABLE}" -B "${bindpose_options}/generate.py" ${kind} ${ARGN} "${path}"
    DEPENDS ${bindpose_descriptions} ${ARGN}
    VERBATIM)
endfunction()
