#!/usr/bin/env bash
# Builds the ParaView plugin and uses it in ParaView, in scripts and in the window. See --help.
set -euo pipefail
program=paraview.sh

usage()
{
  cat <<'TEXT'
usage: tests/paraview.sh [--no-install]

Downloads Debian's ParaView and unpacks it into build/paraview-packages (670 MB). ParaView is not
installed, because its Python package would replace VTK's. Builds filters/paraview against ParaView
in build/paraview-plugin. Then it runs, from tests/paraview,

  in_paraview.py   with pvbatch on 1 and on 2 MPI ranks. check.py compares the results: winding
                   numbers must have the same bits in both runs and in the output of the program
                   bindpose
  proxies.py       with pvbatch: every proxy with its defaults, its icon and its page of the help
  states.py        with pvbatch: the example states of examples/paraview
  window.py        ParaView's window on a display of its own, with mouse and keys: poses and places
                   handles, undo, traces, states, Bend This Surface, deleted inputs

Results, logs and pictures are in build/paraview-results.

options:
  --no-install   install nothing; list missing packages
  --help         show this help
TEXT
}

install=yes
while [ $# -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --no-install) install=no ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done

. "$(dirname "${BASH_SOURCE[0]}")/../examples/setup.sh"
paraview_packages="
libqt5svg5-dev:needed_by_ParaView's_CMake_files
qttools5-dev:needed_by_ParaView's_CMake_files
qttools5-dev-tools:the_help_of_the_plugin
qtxmlpatterns5-dev-tools:the_help_of_the_plugin
openbox:window_manager_for_tests_of_the_window
xdotool:keyboard_and_mouse_input_for_tests_of_the_window
openmpi-bin:runs_several_processes
python3-mpi4py:ParaView's_Python_on_several_processes
"
install_packages "$build_packages $paraview_packages"
build

# ---- ParaView, unpacked ----
packages="$build_dir/paraview-packages"
paraview="$packages/root/usr"
if [ ! -e "$packages/unpacked" ]; then
  echo "Downloading ParaView from Debian ..."
  mkdir -p "$packages"
  # As root, apt may warn that it downloads unsandboxed. The warning is harmless.
  (cd "$packages" && apt-get download paraview paraview-dev python3-paraview) >"$log_dir/paraview-download.log" 2>&1 ||
    { tail -5 "$log_dir/paraview-download.log" >&2; die "apt-get download failed; the log is $log_dir/paraview-download.log"; }
  for package in "$packages"/*.deb; do
    dpkg-deb -x "$package" "$packages/root" || die "$package cannot be unpacked" 5
  done
  touch "$packages/unpacked"
fi
# Install the libraries that ParaView's packages depend on.
libraries=$(for package in "$packages"/paraview_*.deb "$packages"/python3-paraview_*.deb; do
  dpkg-deb -f "$package" Depends
done | tr ',' '\n' | sed -nE 's/^ *(lib[^ ]*).*/\1:ParaView/p' | sort -u)
install_packages "$libraries"

# ---- The plugin ----
plugin_dir="$build_dir/paraview-plugin"
cmake -S "$root/filters/paraview" -B "$plugin_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DParaView_DIR="$(echo "$paraview"/lib/*/cmake/paraview-*)" >"$log_dir/paraview-configure.log" 2>&1 ||
  { tail -20 "$log_dir/paraview-configure.log" >&2; die "configuring failed; the log is $log_dir/paraview-configure.log" 5; }
NINJA_STATUS="[%f/%t] " ninja -C "$plugin_dir" -j "$(nproc)" || die "the build of the plugin failed" 5
rm -rf "$build_dir/paraview-installed"
cmake --install "$plugin_dir" --prefix "$build_dir/paraview-installed" >"$log_dir/paraview-install.log"
plugin=$(echo "$build_dir"/paraview-installed/lib/paraview-*/plugins/Bindpose/Bindpose.so)
help=$(find "$plugin_dir" -name Bindpose.qch)
[ -n "$help" ] || die "the build of the plugin has no help" 5

# ---- Runs ----
mesh=$(/usr/bin/python3 -c '
import pathlib, sys
sys.path.insert(0, sys.argv[1])
import quickstart
print(quickstart.demo_mesh(pathlib.Path(sys.argv[2])))' "$root/examples" "$build_dir/demo-meshes")
results="$build_dir/paraview-results"
rm -rf "$results"

# in_paraview NAME COMMAND…: run a command that starts ParaView, for ten minutes at most. Ranks that wait for each other
# would never end. The log is NAME.log.
in_paraview()
{
  local name=$1
  shift
  mkdir -p "$results/$name"
  (
    export PATH="$paraview/bin:$PATH"
    LD_LIBRARY_PATH=$(echo "$paraview"/lib/*-linux-gnu)
    export LD_LIBRARY_PATH PYTHONPATH="$paraview/lib/python3/dist-packages"
    # In a container, the user may be root, and there may be only one core.
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
    timeout 600 "$@"
  ) >"$results/$name.log" 2>&1 || { tail -20 "$results/$name.log" >&2; die "ParaView failed in $name; the log is $results/$name.log" 5; }
}

tests="$root/tests/paraview"
in_paraview 1 pvbatch "$tests/in_paraview.py" "$plugin" "$mesh" "$results/1"
in_paraview 2 mpirun --bind-to none -n 2 pvbatch "$tests/in_paraview.py" "$plugin" "$mesh" "$results/2"
PYTHONPATH="$build_dir/lib/python3/dist-packages" /usr/bin/python3 "$tests/check.py" \
  "$build_dir" "$mesh" "$results"

in_paraview proxies pvbatch "$tests/proxies.py" "$plugin" "$help" "$results/proxies"
in_paraview states xvfb-run -a -s "-screen 0 1280x1024x24" pvbatch "$tests/states.py" "$plugin" "$results/states"
for name in proxies states; do
  grep -E 'proxies used|a motion of|example states' "$results/$name.log"
done
/usr/bin/python3 "$tests/window.py" "$paraview" "$plugin" "$results/window" ||
  die "the test of ParaView's window failed; logs and pictures are in $results/window" 5
