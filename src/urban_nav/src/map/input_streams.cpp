// SPDX-License-Identifier: BSD-3-Clause
#include "map/input_streams.hpp"

namespace urban_nav {

namespace {

Json pointTimesToJson(const urban_nav_core::PointTimes& times) {
  Json json = Json::object();
  json["field"] = times.areKnown() ? times.field : "none";
  json["unit"] = times.areKnown() ? toString(times.unit) : "none";
  json["reference"] = times.areKnown() ? toString(times.reference) : "none";
  return json;
}

}  // namespace

void appendInputs(const std::vector<urban_nav_input::InputStream>& inputs, Json& array) {
  for (const urban_nav_input::InputStream& input : inputs) {
    Json json = Json::object();
    json["role"] = input.role;
    json["topic"] = input.topic;
    json["frame"] = input.frame;
    json["messages"] = input.messages;
    if (input.lidar) {
      json["points_time"] = pointTimesToJson(input.lidar->times);
      json["sweep_s"] = input.lidar->sweep_s;
      json["rings"] = input.lidar->rings;
      json["deskewed"] = input.lidar->deskewed;
    }
    array.append(json);
  }
}

}  // namespace urban_nav
