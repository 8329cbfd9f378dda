#!/usr/bin/env bash
# Builds the ParaView plugin against an installed ParaView. See --help.
set -euo pipefail
program=build.sh

usage()
{
  cat <<'TEXT'
usage: filters/paraview/build.sh [options] [-- CMAKE OPTIONS…]

Builds the plugin in build/paraview-plugin against ParaView 5.11 and installs it.

Without --prefix, ParaView is that of Debian: the packages paraview, paraview-dev and
python3-paraview are installed if they are missing.

options:
  --prefix PREFIX  folder of another ParaView with development files, which has
                   PREFIX/lib/cmake/paraview-5.11 or PREFIX/lib/…/cmake/paraview-5.11
  --output DIR     where to install the plugin (default: build/paraview-installed)
  --replace-vtk    allow apt to remove python3-vtk9, which conflicts with python3-paraview, and
                   libvtk9-dev, which the main build of Bindpose needs
  --no-install     install no packages; list missing packages
  --help           show this help
TEXT
}

install=yes
prefix=""
output=""
replace_vtk=no
while [ $# -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --prefix) prefix=${2:?--prefix needs the folder of a ParaView}; shift ;;
    --output) output=${2:?--output needs a folder}; shift ;;
    --replace-vtk) replace_vtk=yes ;;
    --no-install) install=no ;;
    --) shift; break ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done

. "$(dirname "${BASH_SOURCE[0]}")/../../examples/setup.sh"
needed=5.11

# find_paraview PREFIX: set $paraview_dir to the folder of ParaView's CMake files, and $version. Of
# several versions, take the newest.
find_paraview()
{
  local config found
  paraview_dir=""
  version=""
  [ -d "$1" ] || die "the folder $1 does not exist"
  for config in "$1"/lib/cmake/paraview-*/paraview-config-version.cmake \
    "$1"/lib64/cmake/paraview-*/paraview-config-version.cmake \
    "$1"/lib/*/cmake/paraview-*/paraview-config-version.cmake; do
    [ -f "$config" ] || continue
    found=$(sed -n 's/^set(PACKAGE_VERSION "\(.*\)")$/\1/p' "$config" | head -n 1)
    if [ "$(printf '%s\n' "$version" "$found" | sort -V | tail -n 1)" = "$found" ]; then
      version=$found
      paraview_dir=$(cd "$(dirname "$config")" && pwd)
    fi
  done
  [ -n "$paraview_dir" ] ||
    die "$1 has no ParaView with development files: expected $1/lib/cmake/paraview-$needed or $1/lib/…/cmake/paraview-$needed"
  [ "$(printf '%s\n' "$needed" "$version" | sort -V | head -n 1)" = "$needed" ] ||
    die "$1 has ParaView $version; the plugin needs ParaView $needed or later"
  case "$version" in
    "$needed" | "$needed".*) ;;
    *) echo "$program: the plugin is tested with ParaView $needed, not with $version" >&2 ;;
  esac
}

# ---- ParaView ----
if [ -n "$prefix" ]; then
  find_paraview "$prefix" # before packages are installed
  install_packages "$kernel_packages libpng-dev:pictures $paraview_help_packages"
else
  if ! is_installed python3-paraview && is_installed python3-vtk9 && [ "$replace_vtk" = no ]; then
    die "Debian's python3-paraview conflicts with the installed python3-vtk9; give --replace-vtk to let apt remove python3-vtk9 and libvtk9-dev, or --prefix PREFIX for a ParaView in another folder"
  fi
  debian_paraview="
paraview:ParaView
paraview-dev:headers_and_CMake_files_of_ParaView
python3-paraview:Python_modules,_which_the_CMake_files_refer_to
"
  install_packages "$kernel_packages $paraview_help_packages $paraview_cmake_packages $debian_paraview"
  find_paraview /usr
fi

# ---- The plugin ----
plugin_dir="$build_dir/paraview-plugin"
cache="$plugin_dir/CMakeCache.txt"
fresh=""
if [ -f "$cache" ] && [ "$(sed -n 's/^ParaView_DIR:[A-Z]*=//p' "$cache")" != "$paraview_dir" ]; then
  fresh=--fresh # the cache has the paths of another ParaView
fi
# shellcheck disable=SC2086
cmake -S "$root/filters/paraview" -B "$plugin_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DParaView_DIR="$paraview_dir" $fresh "$@" >"$log_dir/paraview-configure.log" 2>&1 ||
  { tail -20 "$log_dir/paraview-configure.log" >&2; die "configuring failed; the log is $log_dir/paraview-configure.log" 5; }
NINJA_STATUS="[%f/%t] " ninja -C "$plugin_dir" -j "$(job_count)" || die "the build of the plugin failed" 5
if [ -z "$output" ]; then
  output="$build_dir/paraview-installed"
  rm -rf "$output"
fi
cmake --install "$plugin_dir" --prefix "$output" >"$log_dir/paraview-install.log" ||
  die "installing failed; the log is $log_dir/paraview-install.log" 5
plugin="$(cd "$output" && pwd)/lib/paraview-$(echo "$version" | cut -d. -f1,2)/plugins/Bindpose/Bindpose.so"
[ -f "$plugin" ] || die "the installed plugin $plugin is missing; the log is $log_dir/paraview-install.log" 5
cat <<TEXT
The plugin is $plugin
In the window of ParaView: Tools > Manage Plugins > Load New. In Python:
  from paraview.simple import *
  LoadPlugin("$plugin", remote=False, ns=globals())
TEXT
