#!/usr/bin/env bash
# What is too long for tests/run.sh: sanitizers, the build without GPL and AGPL parts and OpenVDB, a new option in a scratch
# copy, naming, the types of the Python package, the notebooks, the quickstart, every surface of libcgal-demo and every made
# horror through the mesher, weights of twenty surfaces with their certificates, every night 300 other random unclean surfaces
# and 800,000 other poses, every verb on a million triangles to its end and interrupted, weights and tets of hostile models and
# of real furniture models, the plugin in ParaView, a monkey in the window under sanitizers. Some parts take another slice of
# their work every night: half of the sanitized tests, a quarter of the files of the naming check, one of two methods on the
# surfaces, an eighth of the furniture. Ends with a summary.
# usage: tests/nightly.sh [PART…]   (default: all)
# parts: option permissive asan tidy types notebooks quickstart surfaces weights fuzz drags scale hostile real paraview monkey
set -uo pipefail
program=nightly.sh
install=yes
. "$(dirname "${BASH_SOURCE[0]}")/../examples/setup.sh"
nightly_packages="
sweethome3d-furniture:820_real_furniture_models
mypy:type_checker_of_the_Python_package
python3-numpydoc:checker_of_its_documentation
jupyter-nbconvert:runs_the_notebooks
python3-ipykernel:runs_the_notebooks
"
install_packages "$build_packages $test_packages $nightly_packages"
# The compiler cache serves the same source in another folder: the parts permissive and option compile little again.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
build -DBINDPOSE_BUILD_TESTS=ON
# Every night takes other seeds of the random tests, and other slices; a failure names its seed.
export BINDPOSE_FUZZ_NIGHT=${BINDPOSE_FUZZ_NIGHT:-$(($(date +%s) / 86400))}

# slice_of COUNT: print the number of tonight's slice, 1 to COUNT.
slice_of()
{
  echo $((BINDPOSE_FUZZ_NIGHT % $1 + 1))
}

summary=()
# part NAME COMMAND…: runs one part, keeps its log, notes how it ended.
part()
{
  local name=$1 start=$SECONDS verdict=passed
  shift
  echo "== $name"
  "$@" >"$log_dir/nightly-$name.log" 2>&1 || verdict="FAILED (see $log_dir/nightly-$name.log)"
  tail -4 "$log_dir/nightly-$name.log"
  summary+=("$(printf '%-12s %5d s  %s' "$name" $((SECONDS - start)) "$verdict")")
}

# -noreset: the server would refuse who comes while it starts anew, after the last client has left.
under_xvfb()
{
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"
}

asan()
( # its environment is its own
  cmake --preset asan -S "$root" && ninja -C "$root/build-asan" bindpose_core_tests bindpose_filter_tests bindpose_poses_tests \
    bindpose_document_tests bindpose_widget_tests || return 1
  # VTK's and Mesa's one-time allocations are not ours to free.
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 BINDPOSE_FUZZ_FACTOR=${BINDPOSE_FUZZ_FACTOR:-1}
  under_xvfb ctest --test-dir "$root/build-asan" --no-tests=error --output-on-failure -j "$(nproc)" \
    -R '^(core|filters|poses|document|widgets)\.' -I "$(slice_of 2),,2"
)

permissive()
{ # one file at a time: the other builds compile several files as one, which hides a missing #include
  cmake -S "$root" -B "$root/build-permissive" -G Ninja -DBINDPOSE_PERMISSIVE=ON -DBINDPOSE_WITH_OPENVDB=OFF \
    -DBINDPOSE_BUILD_TESTS=ON &&
    ninja -C "$root/build-permissive" bindpose bindpose_core_tests bindpose_filter_tests || return 1
  under_xvfb ctest --test-dir "$root/build-permissive" --no-tests=error --output-on-failure -j "$(nproc)" -R '^(core|filters)\.'
}

option()
{ # three edits add an option to all layers
  local folder="$build_dir/nightly-option"
  rm -rf "$folder"
  /usr/bin/python3 "$root/tests/support/new_option.py" "$folder"
}

tidy()
{
  /usr/bin/python3 "$root/tests/support/check_style.py" --build "$build_dir" --tidy all --slice "$(slice_of 4)/4"
}

types()
{
  /usr/bin/python3 "$root/tests/support/check_python_types.py" --build "$build_dir"
}

notebooks()
{ # their outputs stay in the build folder
  PYTHONPATH="$build_dir/lib/python3/dist-packages" jupyter nbconvert --to notebook --execute \
    --output-dir "$build_dir/nightly-notebooks" "$root"/examples/notebooks/*.ipynb
}

quickstart()
{
  "$root/examples/quickstart.sh" --headless --output "$build_dir/nightly-quickstart"
}

surfaces()
{
  local methods=(remesh embed)
  /usr/bin/python3 "$root/tests/support/all_surfaces.py" --build "$build_dir" --method auto \
    --method "${methods[$(slice_of 2) - 1]}"
}

weights()
{
  /usr/bin/python3 "$root/tests/support/all_weights.py" --build "$build_dir"
}

fuzz()
( # without sanitizers: 300 abused and 80 hostile surfaces, 400 on lattices, 240 wraps
  export BINDPOSE_FUZZ_FACTOR=${BINDPOSE_FUZZ_FACTOR:-10}
  ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -j "$(nproc)" -R '^core\.Fuzz(Tetrahedralize|Wrap)\.'
)

drags()
( # without sanitizers: over 600,000 poses through reduced ARAP, 200,000 through full ARAP
  export BINDPOSE_FUZZ_FACTOR=${BINDPOSE_FUZZ_FACTOR:-12}
  ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -j "$(nproc)" -R '^core\.FuzzPoses\.'
)

scale()
{
  /usr/bin/python3 "$root/tests/support/measure_scale.py" --build "$build_dir" --millions 1 --cancel 2
}

hostile()
{
  /usr/bin/python3 "$root/tests/real_meshes.py" --build "$build_dir" --set hostile --check --time-limit 600 \
    --csv "$build_dir/nightly-hostile.csv" --markdown "$build_dir/nightly-hostile.md"
}

real()
{ # on as many models at once as there are cores: tests/real_meshes.md comes from a run with one at a time
  local slice=${BINDPOSE_REAL_SLICE:-$(slice_of 8)/8} # 1/1: all models
  /usr/bin/python3 "$root/tests/real_meshes.py" --build "$build_dir" --jobs "$(nproc)" --threads 1 --accuracy 4 \
    --slice "$slice" \
    --csv "$build_dir/nightly-real.csv" --markdown "$build_dir/nightly-real.md" \
    --check 'accuracy_rms_median<=0.03' 'weights_leak_max<=0.01'
}

paraview()
{
  "$root/tests/paraview.sh"
}

monkey()
( # five minutes of random events, every night others
  cmake --preset asan -S "$root" && ninja -C "$root/build-asan" bindpose-mesher bindpose_app_tests || return 1
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
  export BINDPOSE_MONKEY_SECONDS=${BINDPOSE_MONKEY_SECONDS:-300} BINDPOSE_MONKEY_SEED=${BINDPOSE_MONKEY_SEED:-$BINDPOSE_FUZZ_NIGHT}
  under_xvfb "$root/build-asan/bin/bindpose_app_tests" --gtest_filter='Monkey.*'
)

parts=("$@")
[ $# -gt 0 ] || parts=(option permissive asan tidy types notebooks quickstart surfaces weights fuzz drags scale hostile real paraview monkey)
for name in "${parts[@]}"; do
  part "$name" "$name"
done
printf '\n%s\n' "Summary"
printf '  %s\n' "${summary[@]}"
! printf '%s\n' "${summary[@]}" | grep -q FAILED
