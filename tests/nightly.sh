#!/usr/bin/env bash
# Runs the tests that take too long for tests/run.sh, and prints a summary.
# usage: tests/nightly.sh [PART…]   (default: all)
# parts:
#   option       add an option to a scratch copy of the project
#   permissive   build and test without GPL and AGPL parts and without OpenVDB
#   includes     check that an eighth of the sources compile one by one
#   asan         a third of the tests under the address and undefined-behavior sanitizers
#   tidy         check the names in a quarter of the kernel files
#   types        check the types and the documentation of the Python package
#   notebooks    run the notebooks
#   wheel        install a wheel of the Python package into a virtual environment
#   gltf         validate the glTF files that tests write by Khronos' gltf-validator
#   quickstart   run examples/quickstart.sh
#   surfaces     tets of all surfaces of libcgal-demo and of tests/support/horrors.py: method auto, and remesh or embed
#   weights      weights of twenty surfaces, checked against their certificates
#   unclean      tets of random unclean surfaces
#   fuzz         libFuzzer under sanitizers, 10 minutes per target: all targets if named, a seventh of them in a whole night
#   drags        random poses
#   scale        all verbs on a million triangles, completed and interrupted; rig on textured characters
#   hostile      weights and tets of synthetic models with severe defects
#   real         weights and tets of an eighth of the real furniture models
#   paraview     the plugin in ParaView
#   blender      glTF files and the add-on in Blender; the add-on and bone heat on a quarter of the surfaces
#   monkey       random events in the window, under sanitizers
# Random seeds, the choice between remesh and embed, and the third, quarter, seventh or eighth of the work change every night.
set -uo pipefail
program=nightly.sh
install=yes
. "$(dirname "${BASH_SOURCE[0]}")/../examples/setup.sh"
nightly_packages="
sweethome3d-furniture:820_real_furniture_models
blender:tests_of_the_add-on_and_of_glTF_files
clang:builds_the_fuzzers
libclang-rt-14-dev:libFuzzer_and_the_sanitizers_of_clang
mypy:checks_the_types_of_the_Python_package
python3-numpydoc:checks_the_documentation_of_the_Python_package
jupyter-nbconvert:runs_the_notebooks
python3-ipykernel:runs_the_notebooks
python3-build:makes_the_wheel
python3-setuptools:makes_the_wheel
python3-wheel:makes_the_wheel
python3-pip:installs_the_wheel
python3-venv:installs_the_wheel
"
install_packages "$build_packages $test_packages $nightly_packages"
# With these settings, the compiler cache ignores the folder, so the parts permissive and option recompile few files.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
# Build everything except the tests, then the only test program that the parts below use.
build -DBINDPOSE_BUILD_TESTS=OFF
build_targets=bindpose_core_tests
build -DBINDPOSE_BUILD_TESTS=ON
# The number of the night sets the seeds of the random tests and the slices. A failed test prints its seed.
export BINDPOSE_FUZZ_NIGHT=${BINDPOSE_FUZZ_NIGHT:-$(($(date +%s) / 86400))}

# slice_of COUNT: print the number of tonight's slice, 1 to COUNT.
slice_of()
{
  echo $((BINDPOSE_FUZZ_NIGHT % $1 + 1))
}

summary=()
# part NAME COMMAND…: run one part, write its log, and add its result to the summary.
part()
{
  local name=$1 start=$SECONDS verdict=passed
  shift
  echo "== $name"
  "$@" >"$log_dir/nightly-$name.log" 2>&1 || verdict="FAILED (see $log_dir/nightly-$name.log)"
  tail -4 "$log_dir/nightly-$name.log"
  summary+=("$(printf '%-12s %5d s  %s' "$name" $((SECONDS - start)) "$verdict")")
}

# -noreset: without it, the X server resets after the last client disconnects and refuses new clients during the reset.
under_xvfb()
{
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"
}

asan()
( # a subshell, so that other parts do not get these environment variables
  cmake --preset asan -S "$root" && ninja -C "$root/build-asan" bindpose_core_tests bindpose_filter_tests bindpose_poses_tests \
    bindpose_document_tests bindpose_widget_tests || return 1
  # detect_leaks=0: VTK and Mesa do not free some one-time allocations.
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 BINDPOSE_FUZZ_FACTOR=${BINDPOSE_FUZZ_FACTOR:-1}
  under_xvfb ctest --test-dir "$root/build-asan" --no-tests=error --output-on-failure -j "$(nproc)" \
    -R '^(core|filters|poses|document|widgets)\.' -I "$(slice_of 3),,3"
)

permissive()
{
  cmake -S "$root" -B "$root/build-permissive" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
    -DBINDPOSE_PERMISSIVE=ON -DBINDPOSE_WITH_OPENVDB=OFF -DBINDPOSE_BUILD_TESTS=ON &&
    ninja -C "$root/build-permissive" bindpose bindpose_core_tests bindpose_filter_tests || return 1
  under_xvfb ctest --test-dir "$root/build-permissive" --no-tests=error --output-on-failure -j "$(nproc)" -R '^(core|filters)\.'
}

includes()
{
  /usr/bin/python3 "$root/tests/support/compile_alone.py" --build "$build_dir" --slice "$(slice_of 8)/8"
}

option()
{ # test that three edits add an option to all layers
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
{ # write the executed notebooks to the build folder
  PYTHONPATH="$build_dir/lib/python3/dist-packages" jupyter nbconvert --to notebook --execute \
    --output-dir "$build_dir/nightly-notebooks" "$root"/examples/notebooks/*.ipynb
}

wheel()
{
  local folder="$build_dir/nightly-wheel"
  rm -rf "$folder"
  cmake --install "$build_dir" --prefix "$folder/installed" &&
    /usr/bin/python3 "$root/python/make_wheel.py" "$folder/installed" --output "$folder" &&
    rm -rf "$folder/installed" && # the wheel must not depend on it
    /usr/bin/python3 -m venv --system-site-packages "$folder/environment" &&
    "$folder/environment/bin/pip" install --no-index --no-deps "$folder"/bindpose-*.whl &&
    "$folder/environment/bin/python" "$root/tests/python/installed_package.py" "$folder/environment"
}

gltf()
{ # The nodes of a glTF file are kept, so a skinned mesh may be at a node with a transform. One test writes a damaged file
  # (cut.glb), one a chain of a million nodes (chain.glb), for which the validator has no stack.
  local cli="$root/tests/viewer/cli" python="$root/tests/python" folder="$build_dir/nightly-gltf"
  local run=(under_xvfb env PYTHONPATH="$build_dir/lib/python3/dist-packages" BINDPOSE_PROGRAM="$build_dir/bin/bindpose"
    /usr/bin/python3 -B -m pytest -q -p no:cacheprovider)
  command -v npm >/dev/null || install_packages "npm:installs_the_validator_of_glTF_files"
  rm -rf "$folder" && mkdir "$folder" &&
    npm install --loglevel error --no-audit --no-fund --prefix "$build_dir/nightly-npm" gltf-validator@2.0.0-dev.3.10 &&
    "${run[@]}" --basetemp "$folder/cli" \
      "$cli/test_assets.py" "$cli/test_look.py" "$cli/test_losses.py" "$cli/test_motions.py" "$cli/test_rigs.py" \
      "$cli/test_transfer.py" "$cli/test_deform.py::test_an_ignored_stretch_is_said_once" \
      "$cli/test_reproducible.py::test_deform" "$cli/test_reproducible.py::test_weights[bounded-biharmonic-surface]" &&
    "${run[@]}" --basetemp "$folder/python" \
      "$python/test_files.py" "$python/test_names.py::test_names_come_back" "$python/test_rigs.py" &&
    /usr/bin/python3 "$root/tests/support/validate_gltf.py" --modules "$build_dir/nightly-npm/node_modules" "$folder" \
      --skip cut.glb --skip chain.glb --allow NODE_SKINNED_MESH_LOCAL_TRANSFORMS
}

quickstart()
{
  build_targets=bindpose "$root/examples/quickstart.sh" --headless --output "$build_dir/nightly-quickstart"
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

unclean()
( # without sanitizers: 300 damaged and 80 hostile surfaces, 400 damaged surfaces on lattices, 240 wraps
  export BINDPOSE_FUZZ_FACTOR=${BINDPOSE_FUZZ_FACTOR:-10}
  ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -j "$(nproc)" -R '^core\.Fuzz(Tetrahedralize|Wrap)\.'
)

fuzz()
{ # a fault ends a target and is written to build-fuzz
  cmake --preset fuzz -S "$root" && ninja -C "$root/build-fuzz" bindpose_fuzz || return 1
  /usr/bin/python3 "$root/tests/support/run_fuzzers.py" --build "$root/build-fuzz" --slice "$fuzz_slice" \
    --seconds "${BINDPOSE_FUZZ_SECONDS:-600}" --markdown "$build_dir/nightly-fuzzing.md"
}

drags()
( # without sanitizers: over 600,000 poses through reduced ARAP, 200,000 through full ARAP
  export BINDPOSE_FUZZ_FACTOR=${BINDPOSE_FUZZ_FACTOR:-12}
  ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -j "$(nproc)" -R '^core\.FuzzPoses\.'
)

scale()
{
  /usr/bin/python3 "$root/tests/support/measure_scale.py" --build "$build_dir" --millions 1 --cancel 2 &&
    /usr/bin/python3 "$root/tests/support/measure_rig.py" --build "$build_dir" --check
}

hostile()
{
  /usr/bin/python3 "$root/tests/real_meshes.py" --build "$build_dir" --set hostile --check --time-limit 600 \
    --csv "$build_dir/nightly-hostile.csv" --markdown "$build_dir/nightly-hostile.md"
}

real()
{ # one model per core at the same time; tests/real_meshes.md comes from a run with one model at a time
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

blender()
{
  under_xvfb ctest --test-dir "$build_dir" --no-tests=error --output-on-failure -R '^blender\.' &&
    /usr/bin/python3 "$root/tests/blender/compare_bone_heat.py" --build "$build_dir" --slice "$(slice_of 4)/4" \
      --markdown "$build_dir/nightly-bone-heat.md"
}

monkey()
( # five minutes of random events; the seed changes every night
  cmake --preset asan -S "$root" && ninja -C "$root/build-asan" bindpose-mesher bindpose_app_tests || return 1
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
  export BINDPOSE_MONKEY_SECONDS=${BINDPOSE_MONKEY_SECONDS:-300} BINDPOSE_MONKEY_SEED=${BINDPOSE_MONKEY_SEED:-$BINDPOSE_FUZZ_NIGHT}
  under_xvfb "$root/build-asan/bin/bindpose_app_tests" --gtest_filter='Monkey.*'
)

parts=("$@")
fuzz_slice=1/1
[ $# -gt 0 ] || fuzz_slice=$(slice_of 7)/7
[ $# -gt 0 ] || parts=(option permissive includes asan tidy types notebooks wheel gltf quickstart surfaces weights unclean fuzz drags scale hostile real paraview blender monkey)
for name in "${parts[@]}"; do
  part "$name" "$name"
done
printf '\n%s\n' "Summary"
printf '  %s\n' "${summary[@]}"
! printf '%s\n' "${summary[@]}" | grep -q FAILED
