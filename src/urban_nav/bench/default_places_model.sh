#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the default model of places from panoramas of simulated worlds whose seeds no test, bench or demo uses: the words
# that `places train` learns from them, and the calibrations, on other sites. Takes some 40 minutes on one core.
# trained.places: words and tree. fabmap_node/config/default.places is such a model, of version 2: stores refer to it by
# its hash, so that a new one is a new model to them.
# calibrations.json: calibrations of panoramas and of single images, which are the first images of panoramas, with the
# words of the model in the tree, for fabmap_node/src/model/supplied_calibrations.cpp; six sites on days 1 to 4 (dry,
# dry, wet, winter), five on one day.
# Usage: default_places_model.sh [FOLDER for bags and results, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
drives=("quad 910001 1 60" "street 910002 1 60" "quad 910004 2 60") # world, seed, day, seconds
sites=("quad 920001 1 20" "quad 920001 2 10" "quad 920001 3 10" "quad 920001 4 10"
  "street 920003 1 40" "street 920003 2 10" "street 920003 3 10" "street 920003 4 10"
  "begbroke 920005 1 20" "begbroke 920005 2 10" "begbroke 920005 3 10" "begbroke 920005 4 10"
  "quad 920002 1 20" "quad 920002 3 10" "quad 920002 4 10" "street 5001 1 20" "street 5001 3 12" "street 5002 3 12"
  "street 920004 1 20" "street 920004 2 10" "street 920004 3 10" "street 920004 4 10"
  "street 921004 1 10" "quad 921001 1 12" "begbroke 921005 1 12" "street 921002 1 10")

# simulate WORLD SEED DAY SECONDS: prints the bag.
simulate() {
  local bag=$folder/$1_$2_$3_$4.bag
  [ -f "$bag" ] || "$root/urban_nav" simulate --world "$1" --seed "$2" --day "$3" --duration "$4" --sensors ladybug -o "$bag" >&2
  echo "$bag"
}

bags=()
for drive in "${drives[@]}"; do
  read -r world seed day seconds <<<"$drive"
  bags+=("$(simulate "$world" "$seed" "$day" "$seconds")")
done
"$root/urban_nav" places train "${bags[@]}" --words 4000 --sampled 240 -o "$folder/trained.places"
days=() options=()
for drive in "${sites[@]}"; do
  read -r world seed day seconds <<<"$drive"
  bag=$(simulate "$world" "$seed" "$day" "$seconds")
  days+=("$bag")
  options+=(--truth "${bag%.bag}.truth/trajectory.tum" --site "$world $seed")
done
"$root/urban_nav" places train --calibrate default "${days[@]}" "${options[@]}" --json "$folder/calibrations.json" \
  -o "$folder/calibrated.places"
echo "$folder"
