// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/place_model.hpp"

namespace fabmap_node {

void useSuppliedPanoramaCalibrations(PlaceModel& model) {
  // bias; weights of PlaceEvidence::values(); limits. Written by src/urban_nav/bench/default_places_model.sh.
  model.panorama = {-7.92947, {4.15831, 18.2025, 12.4086, 17.3943, 0.0}, 0.000968992, 0.998956};
  model.panorama_sequence = {-11.5052, {18.8430, 21.5258, 24.8110, 18.1658, 1.00470}, 0.00110865, 0.998233};
}

}  // namespace fabmap_node
