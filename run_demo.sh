#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Maps a recording and prints the path of the report; runs on a bare Debian 12 too.
#   ./run_demo.sh [FOLDER|BAG...]   folders of KITTI or EuRoC, or bags with a stereo pair
# Without an argument: 60 s of a simulated robot in a college quad, with stereo, panoramas and lasers, mapped in parts of 20 s as
# they come; the bags stay in build/demo for the next run. The results go to out/demo.
set -eu
# shellcheck source=scripts/lib.sh
. "$(dirname "$(readlink -f "$0")")/scripts/lib.sh"

case ${1:-} in -*) sed -n 's/^#   //p' "$0" >&2; exit 2 ;; esac
for input; do [ -e "$input" ] || { say "run_demo.sh: $input: no such file or folder"; exit 2; }; done

out=$root/out/demo seconds=60 part=20

map_inputs() { "$program" map "$@" --out "$out" --overwrite >/dev/null; }  # results are listed at the end

# is_simulated FOLDER: true if it has the complete session of the current simulator.
is_simulated() { [ "$1/quad_$((seconds / part - 1)).bag" -nt "$ws/devel/lib/liburban_nav_sim.so" ]; }

# wait_for FILE LOG: prints the progress of the simulator until it has written the file.
wait_for() {
  local shown line
  shown=$(grep '^simulate' "$2" | tail -n 1)
  until [ -e "$1" ]; do
    kill -0 "$simulator" 2>/dev/null || [ -e "$1" ] || { cat "$2" >&2; die "the session could not be simulated"; }
    sleep 1
    line=$(grep '^simulate' "$2" | tail -n 1)
    if [ "$line" != "$shown" ]; then say "$line"; fi
    shown=$line
  done
}

# Each part is mapped together with the previous ones.
map_while_simulating() {
  local folder=$1 log=$1/simulate.log parts=() bag n
  rm -rf "$folder"
  mkdir -p "$folder"
  : >"$log"
  "$program" simulate --world quad --seed 7 --route return --sensors stereo,ladybug,lasers,imu --duration $seconds --split $part -o "$folder/quad.bag" >/dev/null 2>>"$log" &
  simulator=$!
  trap 'kill $simulator 2>/dev/null' EXIT
  trap 'exit 130' INT TERM
  for ((n = 1; n <= seconds / part; n++)); do
    bag=$folder/quad_$((n - 1)).bag
    wait_for "$bag" "$log"
    parts+=("$bag")
    say "Mapping the first $((n * part)) of $seconds s"
    if [ $n = $((seconds / part)) ]; then break; fi
    map_inputs "${parts[@]}" --so-far "$(awk "BEGIN { print $n * $part / $seconds }")" 2>"$folder/map.log" ||
      { cat "$folder/map.log" >&2; die "the first part could not be mapped"; }
    if [ $n = 1 ]; then say "The first report is ready and is updated with each part: $out/report.html"; fi
  done
  wait $simulator || { tail "$log" >&2; die "the session could not be simulated"; }
  trap - EXIT INT TERM
  map_inputs "${parts[@]}" --so-far 1
}

say "[1/2] Building the command and its dependencies"
if ! command_is_current; then build_command; fi
rm -rf "$out"
mkdir -p "$out"
if [ $# = 0 ]; then
  quad=$build/demo/quad
  say "[2/2] $seconds s of a simulated robot in a college quad"
  if is_simulated "$quad"; then map_inputs "$quad"/quad_*.bag; else map_while_simulating "$quad"; fi
else
  say "[2/2] Mapping $*"
  map_inputs "$@"
fi

here=$(realpath --relative-to=. "$out")
printf '\n'
for file in report.html:"the report, for any browser" trajectory.tum:"the trajectory" landmarks.ply:"the map of landmarks" map.ply:"the map"; do
  if [ -e "$out/${file%%:*}" ]; then printf '%-32s %s\n' "$here/${file%%:*}" "${file#*:}"; fi
done
printf '\nNext, a recording of your own:  %s map YOUR.bag --out out/mine\n' "$(realpath --relative-to=. "$root")/urban_nav"
