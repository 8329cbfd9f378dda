# Lists of packages, and functions that install packages and build. The scripts in examples, tests and
# filters/paraview source this file. It is not a command.

# Packages and their purposes. dpkg is queried for each package, so that only missing packages are
# installed.
kernel_packages="
g++:compiler
cmake:configures_the_build
ninja-build:runs_the_build
ccache:speeds_up_later_builds
python3:generates_code_from_descriptions_of_options
libeigen3-dev:matrices
libspectra-dev:eigenvalues_of_sparse_matrices
libtbb-dev:threads
libopenblas-pthread-dev:fast_dense_kernels_for_CHOLMOD
libsuitesparse-dev:CHOLMOD,_a_sparse_solver
libcgal-dev:exact_intersections_in_bindpose-mesher
libtet1.5-dev:TetGen_in_bindpose-mesher
libopenvdb-dev:OpenVDB,_writes_volumes_as_.vdb_files
libboost-dev:Boost.Graph,_graph_cut_between_inside_and_outside
nlohmann-json3-dev:reports_and_poses_as_JSON
libmuparser-dev:expressions_in_pose_files
libtinygltf-dev:reads_and_writes_rigs_as_glTF_files
libtinyobjloader-dev:reads_materials_of_OBJ_files
"
build_packages="$kernel_packages
libvtk9-dev:VTK,_data_processing_and_rendering
python3-vtk9:VTK_in_Python
python3-dev:the_Python_package
python3-numpy:the_Python_package
libvtk9-qt-dev:the_viewer
qtbase5-dev:the_viewer
libqt5opengl5-dev:the_viewer
libcli11-dev:command_line_options
libpng-dev:pictures
libtiff-dev:pictures
libassimp-dev:reads_FBX,_Collada,_3DS_and_3MF_files
libdraco-dev:reads_glTF_files_that_are_compressed_by_Draco
libmeshoptimizer-dev:reads_glTF_files_that_are_compressed_by_meshopt
xvfb:rendering_without_a_display
xauth:rendering_without_a_display
libgl1-mesa-dri:rendering_without_a_graphics_card
libcgal-demo:example_meshes_such_as_elephant-with-holes.off
"
# find_package(ParaView) requires these development files, but Debian's paraview-dev does not depend on them.
paraview_cmake_packages="
libopenmpi-dev:MPI,_needed_by_ParaView's_CMake_files
python3-mpi4py:MPI_in_Python,_needed_by_ParaView's_CMake_files
python3-dev:needed_by_ParaView's_CMake_files
qtbase5-dev:needed_by_ParaView's_CMake_files
libqt5opengl5-dev:needed_by_ParaView's_CMake_files
libqt5svg5-dev:needed_by_ParaView's_CMake_files
qttools5-dev:needed_by_ParaView's_CMake_files
libavcodec-dev:needed_by_ParaView's_CMake_files
libavformat-dev:needed_by_ParaView's_CMake_files
libavutil-dev:needed_by_ParaView's_CMake_files
libswscale-dev:needed_by_ParaView's_CMake_files
libdouble-conversion-dev:needed_by_ParaView's_CMake_files
libexpat1-dev:needed_by_ParaView's_CMake_files
libfreetype-dev:needed_by_ParaView's_CMake_files
libgdal-dev:needed_by_ParaView's_CMake_files
libgl-dev:needed_by_ParaView's_CMake_files
libgl2ps-dev:needed_by_ParaView's_CMake_files
libglew-dev:needed_by_ParaView's_CMake_files
libhdf5-openmpi-dev:needed_by_ParaView's_CMake_files
libjpeg-dev:needed_by_ParaView's_CMake_files
liblz4-dev:needed_by_ParaView's_CMake_files
liblzma-dev:needed_by_ParaView's_CMake_files
libnetcdf-dev:needed_by_ParaView's_CMake_files
libpng-dev:needed_by_ParaView's_CMake_files
libtheora-dev:needed_by_ParaView's_CMake_files
libtiff-dev:needed_by_ParaView's_CMake_files
libutfcpp-dev:needed_by_ParaView's_CMake_files
libx11-dev:needed_by_ParaView's_CMake_files
libxml2-dev:needed_by_ParaView's_CMake_files
zlib1g-dev:needed_by_ParaView's_CMake_files
"
paraview_help_packages="
qttools5-dev-tools:the_help_of_the_plugin
qtxmlpatterns5-dev-tools:the_help_of_the_plugin
"
test_packages="
libgtest-dev:C++_tests
libgmock-dev:C++_tests
libbenchmark-dev:benchmarks
python3-pytest:Python_tests
openbox:window_manager_for_tests_of_the_window
xdotool:keyboard_and_mouse_input_for_tests_of_the_window
libopenvdb-tools:vdb_print_checks_.vdb_files
clang-format-14:the_format_check
clang-tidy-14:the_naming_check
git:lists_tracked_files_for_the_format_check
"

die()
{
  echo "$program: $1" >&2
  exit "${2:-2}"
}

is_installed()
{
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# install_packages "LIST": print missing packages and their purposes, then install them (unless
# --no-install).
install_packages()
{
  local entry name missing=""
  for entry in $1; do
    name=${entry%%:*}
    case " $missing " in *" $name "*) continue ;; esac # it is in two lists
    if ! is_installed "$name"; then
      if [ -z "$missing" ]; then
        echo "Missing Debian packages:"
      fi
      printf '  %-24s %s\n' "$name" "$(echo "${entry#*:}" | tr _ ' ')"
      missing="$missing $name"
    fi
  done
  if [ -z "$missing" ]; then
    return 0
  fi
  if [ "${install:-yes}" = no ]; then
    die "these packages are missing and --no-install was given; install them with: apt-get install --no-install-recommends$missing"
  fi
  command -v apt-get >/dev/null || die "this system has no apt-get; install the packages above by hand"
  local as_root=""
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || die "installing packages needs root; run: apt-get install --no-install-recommends$missing"
    as_root="sudo"
  fi
  echo "Installing them with apt-get$([ -n "$as_root" ] && echo " (sudo)") ..."
  $as_root apt-get update -qq || echo "$program: apt-get update failed; using the existing package lists" >&2
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing \
    >"$log_dir/apt.log" 2>&1 || { tail -5 "$log_dir/apt.log" >&2; die "apt-get install failed; the log is $log_dir/apt.log"; }
}

# job_count: print how many compiler processes fit into memory and use all cores. CGAL and VTK need about
# 1.5 GB per process.
job_count()
{
  local jobs gigabytes
  jobs=$(nproc)
  gigabytes=$(awk '/MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
  if [ "$gigabytes" -lt "$jobs" ]; then
    jobs=$(( gigabytes > 1 ? gigabytes : 1 ))
  fi
  echo "$jobs"
}

# build [CMAKE OPTIONS…]: configure on the first run and if options are given, then build changed
# files: all targets, or those in $build_targets.
build_targets=${build_targets-}
build()
{
  if [ ! -f "$build_dir/build.ninja" ] || [ $# -gt 0 ]; then
    cmake -S "$root" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON "$@" \
      >"$log_dir/configure.log" 2>&1 ||
      { tail -20 "$log_dir/configure.log" >&2; die "configuring failed; the log is $log_dir/configure.log" 5; }
    sed -n '/-- Bindpose /,/License of bindpose-mesher/p' "$log_dir/configure.log"
  fi
  # shellcheck disable=SC2086
  NINJA_STATUS="[%f/%t] " ninja -C "$build_dir" -j "$(job_count)" $build_targets || die "the build failed" 5
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir="$root/build"
log_dir="$build_dir/logs"
mkdir -p "$log_dir"
