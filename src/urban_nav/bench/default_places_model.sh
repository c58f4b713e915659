#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes fabmap_node/config/default.places: panoramas of simulated worlds whose seeds no test, bench or demo uses, the
# model that `places train` learns from them, and its calibration on two days of another world, whose light differs.
# Takes some twelve minutes on one core.
# Usage: default_places_model.sh [FOLDER for the bags, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
drives=("quad 910001 1" "street 910002 1" "quad 910004 2") # world, seed, day

# simulate WORLD SEED DAY SECONDS: prints the bag.
simulate() {
  local bag=$folder/$1_$2_$3.bag
  [ -f "$bag" ] || "$root/urban_nav" simulate --world "$1" --seed "$2" --day "$3" --duration "$4" --sensors ladybug -o "$bag" >&2
  echo "$bag"
}

bags=()
for drive in "${drives[@]}"; do
  read -r world seed day <<<"$drive"
  bags+=("$(simulate "$world" "$seed" "$day" 60)")
done
"$root/urban_nav" places train "${bags[@]}" --words 4000 --sampled 240 -o "$folder/trained.places"

days=() truths=()
for day in 1 2; do
  bag=$(simulate quad 4242 $day 90)
  days+=("$bag")
  truths+=(--truth "${bag%.bag}.truth/trajectory.tum")
done
"$root/urban_nav" places train --calibrate "$folder/trained.places" "${days[@]}" "${truths[@]}" -o "$root/fabmap_node/config/default.places"
