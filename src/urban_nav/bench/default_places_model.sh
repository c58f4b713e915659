#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes fabmap_node/config/default.places: panoramas of simulated worlds whose seeds no test, bench or demo uses, the
# model that `places train` learns from them, and its calibration on other sites: five on days 1 to 4 (dry, dry, wet,
# winter), whose light differs, and ten on one day each, which look like the others and are not. Takes some 40 minutes
# on one core.
# Usage: default_places_model.sh [FOLDER for the bags, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
drives=("quad 910001 1 60" "street 910002 1 60" "quad 910004 2 60") # world, seed, day, seconds
calibration=("quad 920001 1 40" "quad 920001 2 20" "quad 920001 3 20" "quad 920001 4 20"
  "quad 920002 1 40" "quad 920002 2 20" "quad 920002 3 20" "quad 920002 4 20"
  "street 920003 1 40" "street 920003 2 20" "street 920003 3 20" "street 920003 4 20"
  "street 920004 1 40" "street 920004 2 20" "street 920004 3 20" "street 920004 4 20"
  "begbroke 920005 1 40" "begbroke 920005 2 20" "begbroke 920005 3 20" "begbroke 920005 4 20"
  "quad 921001 1 12" "street 921002 1 12" "quad 921003 1 12" "street 921004 1 12" "begbroke 921005 1 12"
  "quad 921006 1 12" "street 921007 1 12" "quad 921008 1 12" "street 921009 1 12" "begbroke 921010 1 12")

# simulate WORLD SEED DAY SECONDS: prints the bag.
simulate() {
  local bag=$folder/$1_$2_$3.bag
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
for drive in "${calibration[@]}"; do
  read -r world seed day seconds <<<"$drive"
  bag=$(simulate "$world" "$seed" "$day" "$seconds")
  days+=("$bag")
  options+=(--truth "${bag%.bag}.truth/trajectory.tum" --site "$world $seed")
done
"$root/urban_nav" places train --calibrate "$folder/trained.places" "${days[@]}" "${options[@]}" -o "$root/fabmap_node/config/default.places"
