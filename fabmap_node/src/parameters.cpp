// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/parameters.hpp"

#include <cstdint>

namespace fabmap_node {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "fabmap_node",
      {
          {"model", &P::model, "", "default", false, false, {},
           "Model of places (file of places train); default: the model of the suite.",
           "paper 3.2"},
          {"known_probability", &P::known_probability, "", 0.99, 0.5, 1.0, {},
           "A place is reported as KNOWN above this probability.",
           "paper 3.2"},
          {"closure_probability", &P::closure_probability, "", 0.05, 0.0, 1.0, {},
           "A place is proposed as a loop closure above this probability, for geometric verification.",
           "paper 4"},
          {"closures_per_metre", &P::closures_per_metre, "1/m", 3.0, 0.01, 1000.0, {},
           "Largest number of closures proposed per metre driven.",
           "paper 4", {}, Audience::Experts},
          {"enough_closures", &P::enough_closures, "", 3.0, 0.1, 1000.0, {},
           "No more closures are proposed between two stretches of 5 m once the probabilities of those proposed add "
           "up to this number; after as many proposals, only one with a clearly higher probability than all previous "
           "ones.",
           "paper 4", {}, Audience::Experts},
          {"mask", &P::mask, "s", 20.0, 0.0, 100000.0, {},
           "Places of the same session younger than this are not candidates.",
           "paper 3.2"},
          {"descriptor_matching", &P::descriptor_matching, "", true, false, false, {},
           "Compare the likeliest places descriptor by descriptor.",
           "docs/results/fabmap_node.md", {"second_look"}, Audience::Experts},
          {"sequence", &P::sequence, "", true, false, false, {},
           "Use the previous observations as evidence for places of other sessions.",
           "paper 3.2", {}, Audience::Experts},
          {"panorama_features", &P::panorama_features, "", std::int64_t{250}, std::int64_t{50}, std::int64_t{5000}, {},
           "Largest number of features of each image of a panorama.",
           "docs/methods/fabmap_node.md", {}, Audience::Experts},
          {"image_features", &P::image_features, "", std::int64_t{500}, std::int64_t{50}, std::int64_t{5000}, {},
           "Largest number of features of a single image.",
           "docs/methods/fabmap_node.md", {}, Audience::Experts},
      });
  return rows;
}
// clang-format on

FeatureOptions featureOptions(const Parameters& parameters) {
  FeatureOptions options;
  options.single = parameters.image_features;
  options.panorama = parameters.panorama_features;
  return options;
}

}  // namespace fabmap_node
