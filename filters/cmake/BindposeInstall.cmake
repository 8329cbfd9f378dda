# Files for find_package(Bindpose) in other projects: the VTK modules, the kernels and their dependencies.
include(CMakePackageConfigHelpers)
string(REPLACE "VTK::" "" bindpose_required_vtk_components "${bindpose_required_modules}")
list(FILTER bindpose_required_vtk_components EXCLUDE REGEX "^Bindpose::")
string(REPLACE ";" " " bindpose_required_vtk_components "${bindpose_required_vtk_components}")
set(bindpose_config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Bindpose")
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/BindposeConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/BindposeConfig.cmake"
  INSTALL_DESTINATION "${bindpose_config_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/BindposeConfigVersion.cmake"
  VERSION "${PROJECT_VERSION}" COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_BINARY_DIR}/BindposeConfig.cmake"
  "${CMAKE_BINARY_DIR}/BindposeConfigVersion.cmake"
  DESTINATION "${bindpose_config_dir}")
