#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes scene_labeler/config/default.labels: drives through simulated worlds whose seeds no test, bench or demo uses, on
# days of different light and season, and the model that `labels train` learns from their true classes.
# Takes some half an hour on one core. The model holds samples, so that it can be taught.
# Usage: default_labels_model.sh [FOLDER for the bags, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
# world, seed, route, day, seconds
drives=("quad 101 loops 1 25" "quad 104 gardens 2 25" "quad 107 reversed 3 25" "quad 110 loops 5 25" "quad 113 gardens 4 25"
  "begbroke 102 loops 2 25" "begbroke 105 reversed 3 25" "begbroke 108 loops 4 25" "begbroke 111 orbits4 1 25" "begbroke 114 reversed 5 25"
  "street 103 loops 1 25" "street 106 straight300 2 25" "street 109 reversed 4 25" "street 112 orbits4 5 25" "street 115 loops 6 25")

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
