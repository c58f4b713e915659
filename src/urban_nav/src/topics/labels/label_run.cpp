// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {
namespace {

using LabelClock = std::chrono::steady_clock;

void appendProbability(std::string& text, float probability) {
  urban_nav_core::appendNumber(text, std::round(static_cast<double>(probability) * 1e5) / 1e5);
}

}  // namespace

double toRoundDouble(float value) { return std::round(static_cast<double>(value) * 1e6) / 1e6; }

Json LabelRun::toJson(const scene_labeler::LabelModel& model) const {
  Json json = Json::object();
  json["frames"] = frames;
  json["points"] = points;
  std::vector<double> sorted = milliseconds;
  std::sort(sorted.begin(), sorted.end());
  json["ms_per_frame_median"] = sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  json["us_per_point"] = points == 0 ? 0.0 : 1e6 * seconds / static_cast<double>(points);
  Json modalities = Json::array();
  modalities.append("shape");
  if (has_look) modalities.append("look");
  json["modalities"] = std::move(modalities);
  json["unsure_share"] = labelled == 0 ? 0.0 : static_cast<double>(unsure) / static_cast<double>(labelled);
  json["new_place_frames"] = new_place_frames;
  json["precision"] = model.precision;
  json["sure_probability"] =
      model.sure.empty() ? Json() : Json(toRoundDouble(model.sure.rowFor(model.precision).least));
  return json;
}

void labelScenes(const scene_labeler::LabelModel& model, const std::vector<SceneFiles>& scenes, int superpixel,
                 Console& console, const TakeSceneLabels& take, LabelRun& run) {
  if (scenes.empty()) return;
  Progress progress(console, "labels", "scenes", static_cast<std::int64_t>(scenes.size()));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneInput input = readScene(scenes[i]);
    const scene_labeler::Scene& scene = input.scene;
    const auto begin = LabelClock::now();
    scene_labeler::SceneLabels labels = scene_labeler::labelScene(chooseModel(input, model), scene, superpixel);
    const double seconds = std::chrono::duration<double>(LabelClock::now() - begin).count();
    run.seconds += seconds;
    run.milliseconds.push_back(1e3 * seconds);
    run.has_look = run.has_look || !scene.view.image.empty();
    ++run.frames;
    run.new_place_frames += scene_labeler::isNewPlace(labels.share_unlike) ? 1U : 0U;
    run.points += scene.points.size();
    take(i, input, labels);
    for (std::size_t point = 0; point < labels.labels.size(); ++point) {
      run.labelled += labels.labels[point] != scene_labeler::SceneClass::None ? 1U : 0U;
      run.unsure += labels.unsure[point];
    }
    progress.update(static_cast<std::int64_t>(i + 1));
  }
  progress.finish(static_cast<std::int64_t>(scenes.size()));
}

std::string printClassColumns(const std::vector<scene_labeler::SceneClass>& classes) {
  std::string text;
  for (const scene_labeler::SceneClass known : classes) text += std::string(",p_") + toString(known);
  return text;
}

void appendLabelCells(const scene_labeler::SceneLabels& labels, std::size_t i, std::string& text) {
  const std::size_t classes = labels.classes.size();
  text += "," + std::to_string(static_cast<int>(labels.labels[i])) + ",";
  const bool has_answer = labels.labels[i] != scene_labeler::SceneClass::None;
  if (has_answer) appendProbability(text, labels.probability(i));
  for (std::size_t k = 0; k < classes; ++k) {
    text += ",";
    if (has_answer) appendProbability(text, labels.probabilities[i * classes + k]);
  }
  text += has_answer ? "," + std::to_string(static_cast<int>(labels.unsure[i])) + "\n" : ",\n";
}

std::string printSceneLabels(const scene_labeler::SceneLabels& labels) {
  std::string text = "index,label,probability" + printClassColumns(labels.classes) + ",unsure\n";
  for (std::size_t i = 0; i < labels.labels.size(); ++i) {
    text += std::to_string(i);
    appendLabelCells(labels, i, text);
  }
  return text;
}

}  // namespace urban_nav
