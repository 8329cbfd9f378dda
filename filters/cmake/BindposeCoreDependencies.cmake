# Options and dependencies of the kernels. Required: Eigen, TBB, nlohmann-json, muParser, Spectra, the
# headers of tinygltf, tinyobjloader and Boost. Large packages are optional. If a package is missing, the feature
# that needs it reports the name of the package.
option(BINDPOSE_PERMISSIVE "Leave out GPL and AGPL parts (bindpose-mesher, CHOLMOD)" OFF)
option(BINDPOSE_WITH_CHOLMOD "Factor with CHOLMOD's supernodal solver when found" ON)
option(BINDPOSE_WITH_MESHER "Build bindpose-mesher (CGAL, TetGen) when both are found" ON)
option(BINDPOSE_WITH_OPENVDB "Write .vdb files when OpenVDB is found" ON)
option(BINDPOSE_WITH_ASSIMP "Read .fbx, .dae, .3ds, .3mf and .bvh files when assimp is found" ON)
option(BINDPOSE_WITH_DRACO "Read glTF files that are compressed by Draco when it is found" ON)
option(BINDPOSE_WITH_MESHOPTIMIZER "Read glTF files that are compressed by meshopt when meshoptimizer is found" ON)

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(muparser 2.3 REQUIRED)
find_package(Boost 1.71 REQUIRED) # headers: Boost.Graph
find_package(Spectra 1.0 REQUIRED) # headers: eigenvalues
# Only the header of tinygltf is used, without its file access. There is no library to link.
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h)
mark_as_advanced(TINYGLTF_INCLUDE_DIR)
if(NOT TINYGLTF_INCLUDE_DIR)
  message(FATAL_ERROR "tiny_gltf.h is missing; on Debian: apt-get install libtinygltf-dev")
endif()
# The header of tinyobjloader reads materials of OBJ files.
find_path(TINYOBJLOADER_INCLUDE_DIR tiny_obj_loader.h)
mark_as_advanced(TINYOBJLOADER_INCLUDE_DIR)
if(NOT TINYOBJLOADER_INCLUDE_DIR)
  message(FATAL_ERROR "tiny_obj_loader.h is missing; on Debian: apt-get install libtinyobjloader-dev")
endif()

# ---- CHOLMOD (its supernodal module is GPL) ----
set(bindpose_has_cholmod OFF)
if(BINDPOSE_WITH_CHOLMOD AND NOT BINDPOSE_PERMISSIVE)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
  find_library(CHOLMOD_LIBRARY cholmod)
  # libsuitesparse-dev depends on both.
  find_library(BLAS_LIBRARY blas)
  find_library(LAPACK_LIBRARY lapack)
  mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY BLAS_LIBRARY LAPACK_LIBRARY)
  if(CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY AND BLAS_LIBRARY AND LAPACK_LIBRARY)
    set(bindpose_has_cholmod ON)
    if(NOT TARGET SuiteSparse::CHOLMOD)
      add_library(SuiteSparse::CHOLMOD UNKNOWN IMPORTED)
      set_target_properties(SuiteSparse::CHOLMOD PROPERTIES
        IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
    endif()
  endif()
endif()

# ---- bindpose-mesher: CGAL (GPL) and TetGen (AGPL), in a separate process ----
set(bindpose_has_mesher OFF)
if(BINDPOSE_WITH_MESHER AND NOT BINDPOSE_PERMISSIVE)
  find_package(CGAL 5.5 QUIET)
  find_path(TETGEN_INCLUDE_DIR tetgen.h)
  find_library(TETGEN_LIBRARY NAMES tet)
  mark_as_advanced(TETGEN_INCLUDE_DIR TETGEN_LIBRARY)
  if(CGAL_FOUND AND TETGEN_INCLUDE_DIR AND TETGEN_LIBRARY)
    set(bindpose_has_mesher ON)
    if(NOT TARGET TetGen::TetGen)
      add_library(TetGen::TetGen UNKNOWN IMPORTED)
      set_target_properties(TetGen::TetGen PROPERTIES
        IMPORTED_LOCATION "${TETGEN_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${TETGEN_INCLUDE_DIR}"
        INTERFACE_COMPILE_DEFINITIONS TETLIBRARY)
    endif()
  endif()
endif()

# ---- OpenVDB (MPL) ----
# OpenVDB's FindOpenVDB.cmake is not used: it stops the configuration if development files of Boost or
# Blosc are missing, and it sets BUILD_SHARED_LIBS to ON. Since OpenVDB 8.1, version.h contains the
# build options of the library. The headers of OpenVDB 10 include headers of Boost, but Debian's
# package does not depend on them.
set(bindpose_has_openvdb OFF)
if(BINDPOSE_WITH_OPENVDB)
  find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
  find_path(OPENVDB_BOOST_INCLUDE_DIR boost/uuid/uuid.hpp)
  find_library(OPENVDB_LIBRARY openvdb)
  mark_as_advanced(OPENVDB_INCLUDE_DIR OPENVDB_BOOST_INCLUDE_DIR OPENVDB_LIBRARY)
  if(OPENVDB_INCLUDE_DIR AND OPENVDB_BOOST_INCLUDE_DIR AND OPENVDB_LIBRARY)
    set(bindpose_has_openvdb ON)
    if(NOT TARGET OpenVDB::openvdb)
      add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
      set_target_properties(OpenVDB::openvdb PROPERTIES
        IMPORTED_LOCATION "${OPENVDB_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OPENVDB_INCLUDE_DIR};${OPENVDB_BOOST_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES TBB::tbb)
    endif()
  endif()
endif()

# ---- Libraries of bindpose-importer, a separate process ----
set(bindpose_has_assimp OFF)
if(BINDPOSE_WITH_ASSIMP)
  find_package(assimp 5.2 QUIET)
  set(bindpose_has_assimp ${assimp_FOUND})
endif()
set(bindpose_has_draco OFF)
if(BINDPOSE_WITH_DRACO)
  find_package(draco 1.5 QUIET)
  set(bindpose_has_draco ${draco_FOUND})
  # Debian's shared library exports symbols of its own version of tinygltf, which would replace those of Bindpose.
  set(bindpose_draco draco::draco)
  if(TARGET draco::draco_static)
    set(bindpose_draco draco::draco_static)
  endif()
endif()
set(bindpose_has_meshoptimizer OFF)
if(BINDPOSE_WITH_MESHOPTIMIZER)
  find_package(meshoptimizer QUIET) # its version file accepts only the same minor version
  if(meshoptimizer_FOUND AND meshoptimizer_VERSION VERSION_GREATER_EQUAL 0.17)
    set(bindpose_has_meshoptimizer ON)
  endif()
endif()
