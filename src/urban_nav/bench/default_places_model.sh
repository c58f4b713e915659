#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes fabmap_node/config/default.places: panoramas of simulated worlds whose seeds no test, bench or demo uses, and
# the model that `places train` learns from them. Takes some seven minutes on one core. The same bytes come out again.
# Usage: default_places_model.sh [FOLDER for the bags, default: a temporary one]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=${1:-$(mktemp -d)}
drives=("quad 910001 1" "street 910002 1" "quad 910004 2") # world, seed, day

bags=()
for drive in "${drives[@]}"; do
  read -r world seed day <<<"$drive"
  bag=$folder/${world}_$seed.bag
  [ -f "$bag" ] || "$root/urban_nav" simulate --world "$world" --seed "$seed" --day "$day" --duration 60 --sensors ladybug -o "$bag"
  bags+=("$bag")
done
"$root/urban_nav" places train "${bags[@]}" --words 4000 --sampled 240 -o "$root/fabmap_node/config/default.places"
