// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/light.hpp"

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

namespace {

constexpr Light kAllLights[] = {Light::Day, Light::Dusk, Light::Night};

}  // namespace

const char* toString(Light light) {
  switch (light) {
    case Light::Dusk: return "dusk";
    case Light::Night: return "night";
    default: return "day";
  }
}

std::string lightList() {
  std::string list;
  for (const Light light : kAllLights) list += (list.empty() ? "" : ", ") + std::string(toString(light));
  return list;
}

Light parseLight(const std::string& word, const std::string& where) {
  for (const Light light : kAllLights)
    if (word == toString(light)) return light;
  throw urban_nav_core::UserError(where, "\"" + word + "\"", lightList());
}

}  // namespace urban_nav_sim
