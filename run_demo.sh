#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Maps a recording and says where the report is, on a bare Debian 12 too.
#   ./run_demo.sh [FOLDER|BAG...]   folders as KITTI or EuRoC have them, or bags with a stereo pair
# Without an argument: the real sequence of the data folder (URBAN_NAV_DATA, or ../shared/data beside the repository) where
# that is present, else 20 s of a rendered room. The results go to out/demo.
set -eu
# shellcheck source=scripts/lib.sh
. "$(dirname "$(readlink -f "$0")")/scripts/lib.sh"

case ${1:-} in -*) sed -n 's/^#   //p' "$0" >&2; exit 2 ;; esac
for input; do [ -e "$input" ] || { say "run_demo.sh: $input: no such file or folder"; exit 2; }; done

# The small renderer's room: only built where it is needed.
render_room() (
  use_system_tools
  lock
  compile "$ws" "Building the renderer" render_sequence || die "the renderer does not compile"
  rm -rf "$1.partial"
  "$ws/devel/lib/urban_nav_core/render_sequence" "$1.partial" || die "the room could not be rendered"
  mv "$1.partial" "$1"
)

inputs=("$@")
steps=2 data=${URBAN_NAV_DATA:-$root/../shared/data}/stereo/kitti_raw_0926_0005
if [ $# = 0 ] && [ -d "$data" ]; then
  inputs=("$(realpath "$data")")
elif [ $# = 0 ]; then
  inputs=("$build/demo/room")
  steps=3
fi

say "[1/$steps] The command and what it needs"
if ! command_is_current; then build_command; fi
if [ $steps = 3 ]; then
  say "[2/3] No data folder here, so 20 s of a rendered room"
  mkdir -p "$build/demo"
  if [ ! -d "${inputs[0]}" ]; then render_room "${inputs[0]}"; fi
fi
say "[$steps/$steps] Mapping ${inputs[*]}"
out=$root/out/demo
rm -rf "$out"
mkdir -p "$out"
"$program" map "${inputs[@]}" --out "$out"

here=$(realpath --relative-to=. "$out")
printf '\n'
for file in report.html:"the report, for any browser" trajectory.tum:"the trajectory" landmarks.ply:"the map of landmarks" map.ply:"the map"; do
  if [ -e "$out/${file%%:*}" ]; then printf '%-32s %s\n' "$here/${file%%:*}" "${file#*:}"; fi
done
printf '\nNext, a recording of your own:  %s map YOUR.bag --out out/mine\n' "$(realpath --relative-to=. "$root")/urban_nav"
