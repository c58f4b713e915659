#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes scene_labeler/config/default.labels, the model of the robot's side lasers; that of other clouds is made by
# cloud_labels_model.cpp. Drives through simulated worlds whose seeds no test, bench or demo uses, on
# days of different light and season, and the model that `labels train` learns from their true classes.
# Takes some three quarters of an hour on one core. The model holds samples, so that it can be taught.
# Usage: default_labels_model.sh [FOLDER for the bags, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
# world, seed, route, day, seconds
drives=("quad 101 loops 1 60" "quad 104 gardens 2 90" "quad 107 reversed 3 60" "quad 110 loops 5 60" "quad 113 gardens 4 90"
  "quad 116 loops 2 60" "quad 119 gardens 6 60" "quad 122 reversed 1 60" "quad 125 loops 3 60" "quad 128 return 4 60"
  "begbroke 102 loops 2 60" "begbroke 105 reversed 3 60" "begbroke 108 loops 4 60" "begbroke 111 orbits4 1 60" "begbroke 114 reversed 5 60"
  "begbroke 117 loops 6 60" "street 103 loops 1 60" "street 106 straight300 2 60" "street 109 reversed 4 60" "street 112 orbits4 5 60"
  "street 115 loops 6 60" "street 118 loops 3 60" "quad 131 return 1 50" "quad 134 return 2 50" "quad 137 return 3 50"
  "quad 140 return 4 50" "quad 143 return 5 50" "quad 146 return 6 50" "quad 149 return 1 50" "quad 152 return 2 50" "quad 155 return 3 50"
  "quad 158 return 4 50" "quad 161 return 5 50" "quad 164 return 6 50")

bags=() poses=()
for drive in "${drives[@]}"; do
  read -r world seed route day seconds <<<"$drive"
  bag=$folder/${world}_${seed}_$day.bag
  [ -f "$bag" ] || "$root/urban_nav" simulate --world "$world" --seed "$seed" --route "$route" --day "$day" --duration "$seconds" \
    --sensors ladybug,lasers --views lasers -o "$bag"
  bags+=("$bag")
  poses+=(--trajectory "${bag%.bag}.truth/trajectory.tum")
done
"$root/urban_nav" labels train "${bags[@]}" "${poses[@]}" --set scene_labeler.samples=16000 -o "$root/scene_labeler/config/default.labels"
