#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes scene_labeler/config/default.labels: drives through simulated worlds whose seeds no test, bench or demo uses, on
# days of different light and season, and the model that `labels train` learns from their true classes.
# Takes some half an hour on one core.
# Usage: default_labels_model.sh [FOLDER for the bags, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
# world, seed, route, day, seconds
drives=("quad 101 loops 1 40" "quad 104 gardens 2 40" "quad 107 reversed 3 40" "quad 110 loops 5 60" "quad 113 gardens 4 40"
  "begbroke 102 loops 2 40" "begbroke 105 reversed 3 40" "begbroke 108 loops 4 60" "begbroke 111 orbits4 1 60" "begbroke 114 reversed 5 60"
  "street 103 loops 1 40" "street 106 straight300 2 60" "street 109 reversed 4 40" "street 112 orbits4 5 60" "street 115 loops 6 60")

bags=() poses=()
for drive in "${drives[@]}"; do
  read -r world seed route day seconds <<<"$drive"
  bag=$folder/${world}_${seed}_$day.bag
  [ -f "$bag" ] || "$root/urban_nav" simulate --world "$world" --seed "$seed" --route "$route" --day "$day" --duration "$seconds" \
    --sensors ladybug,lasers --views lasers -o "$bag"
  bags+=("$bag")
  poses+=(--trajectory "${bag%.bag}.truth/trajectory.tum")
done
"$root/urban_nav" labels train "${bags[@]}" "${poses[@]}" --set scene_labeler.samples=8000 -o "$root/scene_labeler/config/default.labels"
