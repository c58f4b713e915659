#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests all there is, on a bare Debian 12 too; the last line is the result, and so is the exit status.
#   ./run_tests.sh                  warnings are errors; lint, API pages, gtest, Python, rostest; readers and window once more under sanitizers
#   ./run_tests.sh --since COMMIT   the packages that differ from that commit, their dependents and the command alone
#   ./run_tests.sh --benches        the programs in bench/ are compiled as well
#   ./run_tests.sh --sanitize       all ROS-free cores under the sanitizers, every reader fuzzed for 20 s
#   ./run_tests.sh --coverage       gtest in a build that counts lines and branches; a table for each package
#   ./run_tests.sh --tidy           each source compiled alone; clang-format and clang-tidy over all of them as well
# --since selects by scripts/affected.py, which says on standard error what it selected and why. Lint, catkin_lint and the tables of
# the documents are checked in any case. Everything is tested where a ground package, a script or the build changed, or more than half
# of the packages, or where the commit is not in this clone.
# URBAN_NAV_UNITY=OFF compiles each source alone: slower at first, quicker for a changed file.
# URBAN_NAV_UNITY_BATCH=8 sources at a time instead of 16: a third more time for a first build, less memory, less after a change.
# Tests on real data look in the folder that URBAN_NAV_DATA names, and are skipped without it.
set -eu
# shellcheck source=scripts/lib.sh
. "$(dirname "$(readlink -f "$0")")/scripts/lib.sh"
cd "$root"

usage() { sed -n 's/^#   //p' "$0" >&2; exit 2; }

sanitize=no tidy=no benches=no coverage=no since=''
while [ $# -gt 0 ]; do
  case $1 in
    --sanitize) sanitize=yes ;;
    --tidy) tidy=yes ;;
    --benches) benches=yes ;;
    --coverage) coverage=yes ;;
    --since)
      case ${2:-} in '' | -*) say "--since: the name of a commit is missing"; usage ;; esac
      since=$2
      shift ;;
    *) say "$1: not an option"; usage ;;
  esac
  shift
done

use_system_tools
if [ -n "${URBAN_NAV_DATA:-}" ]; then
  URBAN_NAV_DATA=$(realpath "$URBAN_NAV_DATA")
  export URBAN_NAV_DATA
fi
failed_steps=0

# step NAME COMMAND...: runs it and says how long it took; one that fails counts as a failed test and does not end the
# run.
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

# What is tested: everything, or the packages in `tested`, whose tests need what is in the folders `built`.
selected=everything tested=() built=()

# select_packages: reads what changed since the commit $since. A name that is of no commit ends the run.
select_packages() {
  local lines status=0
  lines=$(scripts/affected.py "$since") || status=$?
  if [ $status = 2 ]; then usage; fi
  if [ $status != 0 ] || [ "$lines" = everything ]; then return; fi
  selected=some
  mapfile -t tested < <(sed -n 's/^test //p' <<<"$lines")
  mapfile -t built < <(sed -n 's/^build //p' <<<"$lines")
}

anything_selected() { [ $selected = everything ] || [ ${#tested[@]} -gt 0 ]; }

# is_selected PACKAGE
is_selected() {
  local name
  if [ $selected = everything ]; then return; fi
  for name in "${tested[@]}"; do
    if [ "$name" = "$1" ]; then return; fi
  done
  return 1
}

# targets_of FOLDER PATTERN...: the targets of a workspace whose whole name matches one of the patterns.
targets_of() {
  local folder=$1
  shift
  ninja -C "$folder/build" -t targets all | sed -n 's/^\([^:]*\): .*/\1/p' | grep -xE "$(IFS='|'; printf '%s' "$*")" | sort -u
}

# wanted_targets FOLDER: what is compiled for the selected tests.
wanted_targets() {
  local name patterns=()
  if [ $selected = everything ]; then
    if [ "$1" = "$ws" ]; then echo all; fi
    echo tests
    if [ $benches = yes ]; then echo urban_nav_benches; fi
    return
  fi
  if [ "$1" = "$ws" ]; then
    for name in "${built[@]}"; do patterns+=("urban_nav/$name/all"); done
  fi
  for name in "${tested[@]}"; do
    patterns+=("$name-([a-z]+-)?(ros)?test")
    if [ $benches = yes ]; then patterns+=("$name-bench-.*"); fi
  done
  targets_of "$1" "${patterns[@]}"
}

# In batches, which takes half the time of a first build; warnings that a batch cannot give are those of --tidy.
build_all() (
  local unity=${URBAN_NAV_UNITY:-ON} targets
  if [ $tidy = yes ]; then unity=OFF; fi
  lock
  configure "$ws" -DCATKIN_ENABLE_TESTING=ON -DURBAN_NAV_BENCH=ON -DURBAN_NAV_WERROR=ON -DURBAN_NAV_SANITIZED_READERS=ON \
    -DURBAN_NAV_TEST_SHARDS="$(nproc)" -DURBAN_NAV_UNITY="$unity" -DURBAN_NAV_UNITY_BATCH="${URBAN_NAV_UNITY_BATCH:-16}"
  mapfile -t targets < <(wanted_targets "$ws")
  if [ ${#targets[@]} = 0 ]; then return; fi
  : >"$ws/command.started"
  compile "$ws" "Building" "${targets[@]}" || return 1
  if is_selected urban_nav; then mv "$ws/command.started" "$ws/command.built"; fi
)

# All cores under the sanitizers, with their tests.
build_cores() (
  local targets
  lock
  configure "$build/cores" -DCATKIN_ENABLE_TESTING=ON -DURBAN_NAV_CORES_ONLY=ON -DURBAN_NAV_SANITIZE=ON -DURBAN_NAV_TEST_SHARDS="$(nproc)" \
    -DCATKIN_BLACKLIST_PACKAGES='urban_nav_msgs;urban_nav_ros;urban_nav_launch;urban_nav_rviz'
  mapfile -t targets < <(wanted_targets "$build/cores")
  if [ ${#targets[@]} = 0 ]; then return; fi
  compile "$build/cores" "Building the sanitized cores" "${targets[@]}"
)

# Everything once more, with counters of lines and branches.
build_coverage() (
  local targets
  lock
  configure "$build/coverage" -DCATKIN_ENABLE_TESTING=ON -DURBAN_NAV_COVERAGE=ON -DURBAN_NAV_UNITY="${URBAN_NAV_UNITY:-ON}" \
    -DURBAN_NAV_UNITY_BATCH="${URBAN_NAV_UNITY_BATCH:-16}" -DURBAN_NAV_TEST_SHARDS="$(nproc)"
  mapfile -t targets < <(wanted_targets "$build/coverage" | grep -v -- '-rostest$')
  if [ ${#targets[@]} = 0 ]; then return; fi
  find "$build/coverage" -name '*.gcda' -delete
  compile "$build/coverage" "Building with counters" "${targets[@]}"
)

# list_tests FOLDER KIND: catkin's own targets for the selected tests of one kind (gtest, sanitized, python, rostest).
list_tests() {
  local packages='[A-Za-z0-9_]*'
  if [ $selected = some ]; then packages=$(IFS='|'; printf '%s' "${tested[*]}"); fi
  targets_of "$1" "run_tests_($packages)_$2_[^/]+"
}

# say_troubles LOG: what in a log of tests is worth a line.
say_troubles() {
  grep -E '^\[  (FAILED|SKIPPED) +\]|^\[ERROR\]|AddressSanitizer|runtime error' "$1" >&2 || true
}

# run_group FOLDER KIND [SECONDS]: the tests of one kind, as many at a time as there are processors, with so many
# seconds of fuzzing a reader; how they end is in the XML files, so this fails only where they did not come to their
# end.
run_group() {
  local targets status=0 limit=$((1200 + 30 * ${3:-0}))
  if [ -n "${3:-}" ]; then export URBAN_NAV_FUZZ_SECONDS=$3; fi
  mapfile -t targets < <(list_tests "$1" "$2")
  if [ ${#targets[@]} = 0 ]; then return; fi
  timeout -k 10 $limit ninja -C "$1/build" -k 0 -j "$(jobs)" "${targets[@]}" >"$1/$2.log" 2>&1 || status=$?
  say_troubles "$1/$2.log"
  [ $status -lt 124 ]
}

# run_ros_test NUMBER COMMAND: with a master of its own, so that it meets no other roscore, and a host name that needs
# no resolver.
run_ros_test() {
  export ROS_HOSTNAME=localhost ROS_HOME=$build/ros_home/$1
  ROS_MASTER_URI=http://localhost:$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI
  mkdir -p "$ROS_HOME"
  bash -c "$2" >"$ROS_HOME/test.log" 2>&1
}

# say_ends ROS_HOME: of a failed ROS test, which processes died and what it wrote last.
say_ends() {
  local log
  if ! grep -q 'RESULT: .*FAIL' "$1/test.log"; then return; fi
  grep -hE 'has died|exit code' "$1/test.log" "$1"/log/*.log "$1"/log/*/*.log 2>/dev/null | sort -u | tail -n 10 >&2 || true
  for log in "$1"/log/*/*-stdout.log; do
    if grep -qE '^\[==========\]|^Ran ' "$log" 2>/dev/null; then tail -n 25 "$log" >&2; fi
  done
}

# The rostests, two at a time: several take the time they take, and leave the processors idle.
run_ros_tests() {
  local target number=0 status=0
  export build
  export -f run_ros_test
  rm -rf "$build/ros_home"
  for target in $(list_tests "$ws" rostest); do
    printf '%d\0%s\0' $((number++)) "$(ninja -C "$ws/build" -t commands "$target" | tail -n 1)"
  done | timeout -k 10 3600 xargs -0 -n 2 -P 2 bash -c 'run_ros_test "$@"' run_ros_test || status=$?
  cat "$build"/ros_home/*/test.log >"$ws/rostest.log"
  for number in "$build"/ros_home/*; do say_ends "$number"; done
  say_troubles "$ws/rostest.log"
  [ $status -lt 124 ]
}

run_tidy() {
  # Tests apart, which count in floating point and grow vectors as they please.
  # clang knows none of the warnings' names that are GCC's alone, and does not need them.
  run-clang-tidy -quiet -p "$ws/build" -j "$(jobs)" "^$ws/src/urban_nav/(src/[a-z_]+|swf_vo)/(src|nodelet|testing|bench|tools)/.*\.cpp$" >"$build/tidy.log" 2>/dev/null || {
    grep -E 'warning:|error:' "$build/tidy.log" | sort -u | head -50 >&2
    return 1
  }
}

run_lint() {
  local results=$build/scripts/test_results/scripts/scripts.xml
  mkdir -p "$build/scripts"
  scripts/unit_tests.py "$results" >"$build/scripts/tests.log" 2>&1 || cat "$build/scripts/tests.log" >&2
  scripts/lint.py && [ -s "$results" ]
}

run_format() {
  git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run -Werror
}

results=("$build/scripts/test_results")
find "$build" -path '*/test_results/*' -name '*.xml' -delete 2>/dev/null || true
tools=()
if [ $tidy = yes ]; then tools=(clang-format clang-tidy clang-tools); fi
step "packages" install_packages "${tools[@]}" || true
if [ -n "$since" ]; then select_packages; fi
if [ $coverage = yes ]; then
  step "packages for coverage" install_packages gcovr || true
  if anything_selected && step "build with counters" build_coverage; then
    step "gtest" run_group "$build/coverage" gtest
    step "coverage" scripts/coverage.py "$build/coverage/build" || true
    results+=("$build/coverage/build/test_results")
  fi || true
elif [ $sanitize = no ]; then
  seconds=${URBAN_NAV_FUZZ_SECONDS:-2}
  step "lint" run_lint || true
  step "API pages" scripts/api_pages.py ${since:+--since "$since"} || true
  if anything_selected && step "build" build_all; then
    step "commands of the documents" scripts/document_commands.py --program "$program" || true
    step "hardening of programs and libraries" scripts/check_binaries.py "$ws/devel" || true
    step "gtest" run_group "$ws" gtest
    step "readers under the sanitizers, $seconds s of fuzzing each" run_group "$ws" sanitized "$seconds"
    step "Python" run_group "$ws" python
    step "rostest" run_ros_tests
    results+=("$ws/build/test_results")
  fi || true
  step "catkin_lint" catkin_lint --offline --rosdistro noetic --strict --quiet . || true
  step "tables of the READMEs" scripts/tables.py || true
  if [ $tidy = yes ]; then
    step "clang-format" run_format || true
    step "clang-tidy" run_tidy || true
  fi
else
  seconds=${URBAN_NAV_FUZZ_SECONDS:-20}
  if anything_selected && step "build under the sanitizers" build_cores; then
    step "tests under the sanitizers, $seconds s of fuzzing a reader" run_group "$build/cores" gtest "$seconds"
    results+=("$build/cores/build/test_results")
  fi || true
fi

scripts/results.py --failed-steps $failed_steps --ninja-log "$ws/build/.ninja_log" --ninja-log "$build/cores/build/.ninja_log" "${results[@]}"
