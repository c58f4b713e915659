// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/place_model.hpp"

namespace fabmap_node {

void useSuppliedCalibrations(PlaceModel& model) {
  // bias; weights of PlaceEvidence::values(); limits. Written by src/urban_nav/bench/default_places_model.sh.
  model.single = {-12.4292, {0.0, 0.0, 24.0086, 11.6108, 0.0}, 0.000853971, 0.999034};
  model.single_sequence = {-12.0985, {0.0, 0.0, 24.5094, 5.02409, 18.3126}, 0.000913242, 0.998675};
  model.panorama = {-6.2876, {12.507, 0.0, 9.44884, 20.4194, 0.0}, 0.000838223, 0.999131};
  model.panorama_sequence = {-15.469, {36.7914, 0.0, 45.1441, 12.8741, 0.735227}, 0.000901713, 0.99884};
}

}  // namespace fabmap_node
