// SPDX-License-Identifier: BSD-3-Clause
#include "view/teach/teach_words.hpp"

#include <nlohmann/json.hpp>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr double kLargestRadius = 100.0;  // m
constexpr std::uint64_t kLargestPoint = 0xfffffffeU;
constexpr const char* kExpectedWords = R"({"action": "correct", "point": 12, "radius": 0.5, "class": "paved"})";

scene_labeler::SceneClass classIn(const nlohmann::json& json) {
  if (!json.contains("class") || !json["class"].is_string()) throw UserError("class", "is missing", kExpectedWords);
  const std::string& name = json["class"].get_ref<const std::string&>();
  if (name == toString(scene_labeler::SceneClass::None)) return scene_labeler::SceneClass::None;
  const auto known = scene_labeler::classFromName(name);
  if (!known) throw UserError("class", name.substr(0, 40), scene_labeler::classNames() + ", none");
  return *known;
}

}  // namespace

TeachWords parseTeachWords(std::string_view text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) throw UserError("request", "is not a JSON object", kExpectedWords);
  for (const auto& [key, value] : json.items())
    if (key != "action" && key != "point" && key != "radius" && key != "class")
      throw UserError("request", "has a member \"" + key.substr(0, 40) + "\"", kExpectedWords);
  const std::string action = json.contains("action") && json["action"].is_string() ? json["action"] : "";
  TeachWords words;
  if (action == "undo" || action == "redo") {
    words.action = action == "undo" ? TeachWords::Action::Undo : TeachWords::Action::Redo;
    return words;
  }
  if (action != "correct") throw UserError("action", action.substr(0, 40), "correct, undo, redo");
  if (!json.contains("point") || !json["point"].is_number_unsigned() || json["point"] > kLargestPoint)
    throw UserError("point", "is not the index of a point", kExpectedWords);
  words.correction.point = json["point"];
  if (json.contains("radius")) {
    if (!json["radius"].is_number() || !(json["radius"] >= 0.0 && json["radius"] <= kLargestRadius))
      throw UserError("radius", "is not a number within 0...100 m", kExpectedWords);
    words.correction.radius = json["radius"];
  }
  words.correction.label = classIn(json);
  return words;
}

}  // namespace urban_nav
