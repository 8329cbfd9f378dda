#!/usr/bin/env bash
# Builds the ParaView plugin and uses it in ParaView, in scripts and in the window. See --help.
set -euo pipefail
program=paraview.sh

usage()
{
  cat <<'TEXT'
usage: tests/paraview.sh [options]

Downloads Debian's ParaView and unpacks it into build/paraview-packages (670 MB). ParaView is not
installed, because its Python package would replace VTK's. Builds the plugin against it with
filters/paraview/build.sh. Then it runs, from tests/paraview,

  in_paraview.py    with pvbatch on 1 and on 2 MPI ranks. check.py compares the results: winding
                    numbers must have the same bits in both runs and in the output of the program
                    bindpose; weights and poses of distributed data the same bits in both runs
  client_server.py  the same work with pvserver
  proxies.py        with pvbatch: every proxy with its defaults, its icon and its page of the help
  states.py         with pvbatch: the example states of examples/paraview
  window.py         ParaView's window on a display of its own, with mouse and keys: poses and places
                    handles, undo, traces, states, Bend This Surface, deleted inputs

Results, logs and pictures are in build/paraview-results.

options:
  --scaling        only measure how the work scales with the number of ranks, with
                   tests/paraview/scaling_table.py; takes some minutes
  --markdown FILE  with --scaling: write the tables to FILE
                   (default: build/paraview-results/scaling.md)
  --no-install     install nothing; list missing packages
  --help           show this help
TEXT
}

install=yes
scaling=no
markdown=""
while [ $# -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --scaling) scaling=yes ;;
    --markdown) markdown=$(realpath -m "${2:?--markdown needs a file}"); shift ;;
    --no-install) install=no ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done

. "$(dirname "${BASH_SOURCE[0]}")/../examples/setup.sh"
run_packages="
openbox:window_manager_for_tests_of_the_window
xdotool:keyboard_and_mouse_input_for_tests_of_the_window
openmpi-bin:runs_several_processes
"
install_packages "$build_packages $paraview_cmake_packages $run_packages"
[ "$scaling" = yes ] || build

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
# refused TEXT OPTIONS…: check that build.sh refuses the options with one line that contains TEXT.
refused()
{
  local expected=$1 output
  shift
  output=$("$root/filters/paraview/build.sh" --no-install "$@" 2>&1) && die "build.sh accepts $*" 5
  case "$output" in
    *$'\n'*) die "build.sh $* prints more than one line: $output" 5 ;;
    *"$expected"*) ;;
    *) die "build.sh $* prints '$output' instead of '$expected'" 5 ;;
  esac
}

if [ "$scaling" = no ]; then
  old="$build_dir/paraview-results/old"
  mkdir -p "$old/lib/cmake/paraview-5.9"
  echo 'set(PACKAGE_VERSION "5.9.1")' >"$old/lib/cmake/paraview-5.9/paraview-config-version.cmake"
  refused "does not exist" --prefix "$build_dir/no-folder"
  refused "has no ParaView with development files" --prefix "$root/tests"
  refused "has ParaView 5.9.1; the plugin needs ParaView 5.11" --prefix "$old"
  is_installed python3-paraview || refused "conflicts with the installed python3-vtk9"
fi
options=(--prefix "$paraview")
[ "$install" = yes ] || options+=(--no-install)
"$root/filters/paraview/build.sh" "${options[@]}"
plugin=$(echo "$build_dir"/paraview-installed/lib/paraview-*/plugins/Bindpose/Bindpose.so)
help=$(find "$build_dir/paraview-plugin" -name Bindpose.qch)
[ -n "$help" ] || die "the build of the plugin has no help" 5

# ---- Runs ----
mesh=$(/usr/bin/python3 -c '
import pathlib, sys
sys.path.insert(0, sys.argv[1])
import quickstart
print(quickstart.demo_mesh(pathlib.Path(sys.argv[2])))' "$root/examples" "$build_dir/demo-meshes")
results="$build_dir/paraview-results"
rm -rf "$results"
mkdir -p "$results"

# with_paraview COMMAND…: run a command that finds ParaView's programs, libraries and Python modules.
with_paraview()
(
  export PATH="$paraview/bin:$PATH"
  LD_LIBRARY_PATH=$(echo "$paraview"/lib/*-linux-gnu)
  export LD_LIBRARY_PATH PYTHONPATH="$paraview/lib/python3/dist-packages"
  # In a container, the user may be root, and there may be only one core.
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  "$@"
)

if [ "$scaling" = yes ]; then
  with_paraview /usr/bin/python3 "$root/tests/paraview/scaling_table.py" --plugin "$plugin" --mesh "$mesh" \
    --folder "$results/scaling" --csv "$results/scaling.csv" --markdown "${markdown:-$results/scaling.md}" --check
  exit
fi

# in_paraview NAME COMMAND…: run a command that starts ParaView, for ten minutes at most. Ranks that wait for each other
# would never end. The log is NAME.log.
in_paraview()
{
  local name=$1
  shift
  mkdir -p "$results/$name"
  with_paraview timeout 600 "$@" >"$results/$name.log" 2>&1 ||
    { tail -20 "$results/$name.log" >&2; die "ParaView failed in $name; the log is $results/$name.log" 5; }
}

tests="$root/tests/paraview"
in_paraview 1 pvbatch "$tests/in_paraview.py" "$plugin" "$mesh" "$results/1"
in_paraview 2 mpirun --bind-to none -n 2 pvbatch "$tests/in_paraview.py" "$plugin" "$mesh" "$results/2"
PYTHONPATH="$build_dir/lib/python3/dist-packages" /usr/bin/python3 "$tests/check.py" \
  "$build_dir" "$mesh" "$results"
with_paraview /usr/bin/python3 "$root/tests/paraview/client_server.py" "$plugin" "$mesh" "$results" ||
  die "the client/server session failed; the logs are $results/client-*.log and $results/server-*.log" 5

in_paraview proxies pvbatch "$tests/proxies.py" "$plugin" "$help" "$results/proxies"
in_paraview states xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvbatch "$tests/states.py" "$plugin" "$results/states"
for name in proxies states; do
  grep -E 'proxies used|a motion of|example states' "$results/$name.log"
done
/usr/bin/python3 "$tests/window.py" "$paraview" "$plugin" "$results/window" ||
  die "the test of ParaView's window failed; logs and pictures are in $results/window" 5
