#!/usr/bin/env bash
# From a fresh clone to a bent mesh in one command: installs missing packages, builds, and runs the
# whole pipeline (winding number, tets, weights, poses) on a real, unclean mesh. See --help.
set -euo pipefail
program=quickstart.sh

usage()
{
  cat <<'TEXT'
usage: examples/quickstart.sh [MESH] [options]

Computes winding numbers, tets, weights and posed shapes of MESH (off, obj, ply, stl, vtp; default:
elephant-with-holes.off of the Debian package libcgal-demo) and writes datasets, pictures and
report.json.

options:
  --handles FILE|auto[:N]  handles as .tgf or .vtp, or N points (default: 8) spread over the surface
                           (default: the elephant's skeleton; auto for any other MESH)
  --pose FILE              pose sequence as JSON (default: generated from the handles)
  --output DIR             output folder (default: quickstart-output)
  --headless               do not open the viewer at the end, even with a display
  --no-install             install nothing; list missing packages
  --help                   show this help
TEXT
}

install=yes
arguments=()
while [ $# -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --no-install) install=no ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
install_packages "$build_packages"
build
exec /usr/bin/python3 "$root/examples/quickstart.py" --build "$build_dir" ${arguments[@]+"${arguments[@]}"}
