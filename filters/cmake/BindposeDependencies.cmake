# Find the dependencies. Required: VTK, CLI11, libpng, libtiff and the dependencies of the kernels. Other packages are needed only
# for options.

# Find Python before VTK. Prefer the system's Python, because another interpreter on PATH may lack VTK and NumPy.
if(BINDPOSE_WRAP_PYTHON)
  if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the package is built for")
  endif()
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
endif()

set(bindpose_vtk_components
  CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms
  CommonComputationalGeometry
  FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersModeling FiltersSources
  ImagingCore InteractionStyle InteractionWidgets
  IOCore IOGeometry IOImage IOLegacy IOPLY IOXML
  ParallelCore
  RenderingAnnotation RenderingCore RenderingFreeType RenderingOpenGL2
  RenderingVolume RenderingVolumeOpenGL2)
if(BINDPOSE_WRAP_PYTHON)
  list(APPEND bindpose_vtk_components WrappingPythonCore Python)
endif()
find_package(VTK 9.1 REQUIRED COMPONENTS ${bindpose_vtk_components}
  OPTIONAL_COMPONENTS GUISupportQt)
find_package(CLI11 2.1 REQUIRED)
find_package(PNG REQUIRED)
find_package(TIFF REQUIRED)
include(BindposeCoreDependencies)

# ---- Qt viewer ----
set(bindpose_has_qt OFF)
if(BINDPOSE_WITH_QT AND TARGET VTK::GUISupportQt)
  find_package(Qt5 5.15 QUIET COMPONENTS Widgets)
  if(Qt5_FOUND)
    set(bindpose_has_qt ON)
  endif()
endif()

# ---- Tests and benchmarks ----
if(BINDPOSE_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
if(BINDPOSE_BUILD_BENCHMARKS)
  find_package(benchmark QUIET)
endif()
