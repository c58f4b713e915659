// SPDX-License-Identifier: BSD-3-Clause
// State of a scene for the page of `labels teach`.
#include <algorithm>
#include <array>
#include <cstdio>

#include "topics/labels/class_colours.hpp"
#include "view/teach/teach_source.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;

namespace {

std::string hexColour(const ClassColour& colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(colour.red),
                static_cast<unsigned>(colour.green), static_cast<unsigned>(colour.blue));
  return text.data();
}

}  // namespace

/// Returns the classes to choose from: the kinds of wall, or wall for a model that does not distinguish them.
Json TeachSource::classesAsJson() const {
  const std::vector<SceneClass>& known = teacher_.base().classes;
  const bool has_one_wall = std::find(known.begin(), known.end(), SceneClass::Wall) != known.end();
  Json classes = Json::array();
  for (std::size_t k = 0; k < scene_labeler::kClassCount; ++k) {
    const auto label = static_cast<SceneClass>(k);
    const bool is_kind_of_wall = label == SceneClass::TexturedWall || label == SceneClass::SmoothWall;
    if (has_one_wall ? is_kind_of_wall : label == SceneClass::Wall) continue;
    classes.append(Json::object({{"number", k}, {"name", toString(label)}, {"colour", hexColour(classColour(label))}}));
  }
  return classes;
}

Json TeachSource::placeAsJson(std::uint32_t point) const {
  Json place = Json::array();
  for (int k = 0; k < 3; ++k) place.append(static_cast<double>(teacher_.scene().points[point][k]));
  return place;
}

Json TeachSource::correctionsAsJson() const {
  Json corrections = Json::array();
  std::size_t number = 0;
  for (const LabelCorrection& one : corrections_.active()) {
    std::size_t points = 0;
    for (const std::uint32_t unit : units_.near(one.point, one.radius)) points += units_.count(unit);
    corrections.append(Json::object({{"number", ++number},
                                     {"class", toString(one.label)},
                                     {"point", static_cast<std::int64_t>(one.point)},
                                     {"radius", static_cast<double>(one.radius)},
                                     {"points", points},
                                     {"place", placeAsJson(one.point)}}));
  }
  return corrections;
}

Json TeachSource::suggestionsAsJson() const {
  Json suggestions = Json::array();
  for (const TeachSuggestion& one : suggestions_)
    suggestions.append(Json::object({{"point", static_cast<std::int64_t>(one.point)},
                                     {"place", placeAsJson(one.point)},
                                     {"units", one.units},
                                     {"area_m2", one.area},
                                     {"worth_m2", one.worth},
                                     {"class", toString(one.label)},
                                     {"second", toString(one.second)},
                                     {"probability", one.probability}}));
  return suggestions;
}

Json TeachSource::countsAsJson() const {
  std::array<std::size_t, scene_labeler::kClassCount> counts{};
  std::size_t answered = 0, unsure = 0, corrected = 0;
  for (std::size_t i = 0; i < corrected_.size(); ++i) {
    const SceneClass label = corrected_[i] != SceneClass::None ? corrected_[i] : answer_.labels[i];
    if (label == SceneClass::None) continue;
    ++answered;
    ++counts[toIndex(label)];
    corrected += corrected_[i] != SceneClass::None ? 1U : 0U;
    unsure += corrected_[i] == SceneClass::None && answer_.unsure[i] != 0 ? 1U : 0U;
  }
  Json classes = Json::object();
  for (std::size_t k = 0; k < counts.size(); ++k) classes[toString(static_cast<SceneClass>(k))] = counts[k];
  return Json::object({{"points", units_.points()},
                       {"answered", answered},
                       {"unsure", unsure},
                       {"corrected", corrected},
                       {"classes", classes}});
}

std::string TeachSource::state() {
  const std::lock_guard lock(mutex_);
  const cv::Mat& image = teacher_.scene().view.image;
  Json json = Json::object({{"scene", files_.points},
                            {"model", model_name_},
                            {"file", file_.path()},
                            {"revision", events_.state().revision},
                            {"read_only", read_only_},
                            {"units", units_.size()},
                            {"can_undo", corrections_.canUndo()},
                            {"can_redo", corrections_.canRedo()},
                            {"edited_elsewhere", !corrections_.base().empty()},
                            {"fault", fault_}});
  Json offset = Json::array();
  for (int k = 0; k < 3; ++k) offset.append(offset_[k]);
  json["offset"] = std::move(offset);
  json["image"] = image.empty() ? Json() : Json::object({{"width", image.cols}, {"height", image.rows}});
  json["classes"] = classesAsJson();
  json["corrections"] = correctionsAsJson();
  json["suggestions"] = suggestionsAsJson();
  json["counts"] = countsAsJson();
  return json.print();
}

}  // namespace urban_nav
