#!/usr/bin/env bash
# Installs the packages that the tests need, builds, and runs all tests under Xvfb. See --help.
set -euo pipefail
program=run.sh

usage()
{
  cat <<'TEXT'
usage: tests/run.sh [options] [-- CTEST OPTIONS…]

options:
  --bless NAME   replace the baseline picture of render test NAME by its current picture, then exit
  --no-install   install nothing; list missing packages
  --help         show this help

All arguments after -- are passed to ctest, for example: tests/run.sh -- -R weights
In an existing build tree, only the test programs that these options select are built.
A skipped test counts as a failure.
TEXT
}

install=yes
bless=""
while [ $# -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --no-install) install=no ;;
    --bless) bless=${2:?--bless needs the name of a render test}; shift ;;
    --) shift; break ;;
    *) usage >&2; exit 1 ;;
  esac
  shift
done

. "$(dirname "${BASH_SOURCE[0]}")/../examples/setup.sh"
install_packages "$build_packages $test_packages"

# targets_of CTEST OPTIONS…: print the test programs that the options select. Print nothing if the
# whole build is needed: a test is a script, or some test program was never built.
targets_of()
{
  /usr/bin/python3 - "$build_dir" "$@" <<'PYTHON' 2>/dev/null || true
import json, pathlib, subprocess, sys

def tests(*options):
    words = ["ctest", "--test-dir", sys.argv[1], "--show-only=json-v1", *options]
    return json.loads(subprocess.run(words, capture_output=True, check=True).stdout)["tests"]

programs = {pathlib.Path(test.get("command", ["none"])[0]) for test in tests(*sys.argv[2:])}
all_built = not any("_NOT_BUILT" in test["name"] for test in tests())
if all_built and all(program.parent == pathlib.Path(sys.argv[1], "bin") for program in programs):
    print(*sorted(program.name for program in programs))
PYTHON
}
if [ $# -gt 0 ] && [ -z "$bless" ] && [ -f "$build_dir/CTestTestfile.cmake" ]; then
  build_targets=$(targets_of "$@")
fi
build -DBINDPOSE_BUILD_TESTS=ON

# -noreset: without it, the X server resets after the last client disconnects and refuses new clients during the reset.
under_xvfb()
{
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"
}

if [ -n "$bless" ]; then
  BINDPOSE_BLESS="$bless" under_xvfb ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -R "^render\\.$bless\$"
  exit
fi

log="$log_dir/ctest.log"
status=0
under_xvfb ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -j "$(nproc)" "$@" 2>&1 | tee "$log" || status=$?
if grep -qE '\*\*\*(Skipped|Not Run)' "$log"; then
  echo "$program: a test was skipped, which counts as a failure" >&2
  status=1
fi
exit "$status"
