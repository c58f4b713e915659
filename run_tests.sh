#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests all there is, on a bare Debian 12 too; the last line is the result, and so is the exit status.
#   ./run_tests.sh              warnings are errors; lint, gtest, Python, rostest; readers and window once more under sanitizers
#   ./run_tests.sh --sanitize   all ROS-free cores under the sanitizers, every reader fuzzed for a minute
#   ./run_tests.sh --tidy       clang-format and clang-tidy over all sources as well
# Tests on real data look in the folder that URBAN_NAV_DATA names, and are skipped without it.
set -eu
# shellcheck source=scripts/lib.sh
. "$(dirname "$(readlink -f "$0")")/scripts/lib.sh"
cd "$root"

sanitize=no tidy=no
for argument; do
  case $argument in
    --sanitize) sanitize=yes ;;
    --tidy) tidy=yes ;;
    *) sed -n 's/^#   //p' "$0" >&2; exit 2 ;;
  esac
done

use_system_tools
if [ -n "${URBAN_NAV_DATA:-}" ]; then
  URBAN_NAV_DATA=$(realpath "$URBAN_NAV_DATA")
  export URBAN_NAV_DATA
fi
failed_steps=0

# step NAME COMMAND...: runs it and says how long it took; one that fails counts as a failed test and does not end the run.
step() {
  local name=$1 start=$SECONDS
  shift
  say "== $name"
  if ("$@"); then
    say "== $name: done in $((SECONDS - start)) s"
  else
    say "== $name: FAILED after $((SECONDS - start)) s"
    failed_steps=$((failed_steps + 1))
    return 1
  fi
}

build_all() (
  lock
  configure "$ws" -DCATKIN_ENABLE_TESTING=ON -DURBAN_NAV_BENCH=ON -DURBAN_NAV_WERROR=ON
  : >"$ws/command.started"
  compile "$ws" "Building" all tests urban_nav_benches || return 1
  mv "$ws/command.started" "$ws/command.built"
)

# build_cores ROOMS PACKAGES: the cores of these packages under the sanitizers, with the tests of these folders of test/ (all, if empty).
build_cores() (
  lock
  configure "$build/cores" -DCATKIN_ENABLE_TESTING=ON -DURBAN_NAV_CORES_ONLY=ON -DURBAN_NAV_SANITIZE=ON \
    -DCATKIN_WHITELIST_PACKAGES="$2" -DURBAN_NAV_TEST_ROOMS="$1"
  compile "$build/cores" "Building the sanitized cores" tests
)

# run_group FOLDER KIND JOBS: the tests of one kind (gtest, python, rostest) by catkin's own targets; how they end is in the XML files,
# so this fails only where they did not come to their end.
run_group() {
  local targets status=0 limit=$((1200 + 30 * ${URBAN_NAV_FUZZ_SECONDS:-0}))
  mapfile -t targets < <(ninja -C "$1/build" -t targets all | sed -n "s/^\(run_tests_[A-Za-z0-9_]*_$2_[^:/]*\): phony.*/\1/p" | sort -u)
  if [ ${#targets[@]} = 0 ]; then return; fi
  timeout -k 10 $limit ninja -C "$1/build" -k 0 -j "$3" "${targets[@]}" >"$1/$2.log" 2>&1 || status=$?
  grep -E '^\[  (FAILED|SKIPPED) +\]|^\[ERROR\]|AddressSanitizer|runtime error' "$1/$2.log" >&2 || true
  [ $status -lt 124 ]
}

run_ros_tests() {
  # A master of our own, so that no running roscore is met, and a host name that needs no resolver.
  ROS_MASTER_URI=http://localhost:$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI ROS_HOSTNAME=localhost ROS_HOME=$build/ros_home
  run_group "$ws" rostest 1
}

run_tidy() {
  # Tests apart, which count in floating point and grow vectors as they please.
  # clang knows none of the warnings' names that are GCC's alone, and does not need them.
  run-clang-tidy -quiet -p "$ws/build" -j "$(jobs)" "^$ws/src/urban_nav/(src/[a-z_]+|swf_vo)/(src|nodelet|testing|bench|tools)/.*\.cpp$" >"$build/tidy.log" 2>/dev/null || {
    grep -E 'warning:|error:' "$build/tidy.log" | sort -u | head -50 >&2
    return 1
  }
}

run_format() {
  git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run -Werror
}

results=()
find "$build" -path '*/test_results/*' -name '*.xml' -delete 2>/dev/null || true
tools=()
if [ $tidy = yes ]; then tools=(clang-format clang-tidy clang-tools); fi
step "packages" install_packages "${tools[@]}" || true
if [ $sanitize = no ]; then
  if step "build" build_all; then
    step "gtest" run_group "$ws" gtest "$(jobs)"
    step "Python" run_group "$ws" python "$(jobs)"
    step "rostest" run_ros_tests
    results+=("$ws/build/test_results")
  fi || true
  step "catkin_lint" catkin_lint --offline --rosdistro noetic --strict --quiet . || true
  step "tables of the READMEs" scripts/tables.py || true
  if [ $tidy = yes ]; then
    step "clang-format" run_format || true
    step "clang-tidy" run_tidy || true
  fi
fi

rooms='io;parameters;window;state;blocks;schema;stores;support' packages='urban_nav_core;urban_nav_store;urban_nav_live;swf_vo;loop_metric;urban_nav' seconds=${URBAN_NAV_FUZZ_SECONDS:-20}
if [ $sanitize = yes ]; then rooms='' packages+=';urban_nav_sim' seconds=${URBAN_NAV_FUZZ_SECONDS:-60}; fi
export URBAN_NAV_FUZZ_SECONDS=$seconds
if step "build under the sanitizers" build_cores "$rooms" "$packages"; then
  step "tests under the sanitizers, $seconds s of fuzzing a reader" run_group "$build/cores" gtest "$(jobs)"
  results+=("$build/cores/build/test_results")
fi || true

scripts/results.py --failed-steps $failed_steps --ninja-log "$ws/build/.ninja_log" --ninja-log "$build/cores/build/.ninja_log" "${results[@]}"
