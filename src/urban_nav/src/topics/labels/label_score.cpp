// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_score.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "scene_labeler/labelling/superpixels.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using scene_labeler::kClassCount;
using scene_labeler::SceneClass;

namespace {

double shareOrZero(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

const char* nameAt(std::size_t index) {
  return toString(index < kClassCount ? static_cast<SceneClass>(index) : SceneClass::None);
}

std::string percentText(double share) { return urban_nav_core::printNumber(std::round(1000.0 * share) / 10.0) + " %"; }

}  // namespace

void LabelScore::add(const scene_labeler::SceneLabels& labels, const std::vector<SceneClass>& truth) {
  std::array<std::set<std::uint32_t>, kClassCount> patches;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == SceneClass::None) continue;
    const SceneClass expected = one_wall_ ? withOneWall(truth[i]) : truth[i];
    const SceneClass answer = one_wall_ ? withOneWall(labels.labels[i]) : labels.labels[i];
    ++points_;
    const std::size_t column = answer == SceneClass::None ? kNoneIndex : toIndex(answer);
    ++confusion_[toIndex(expected)][column];
    if (labels.unsure[i] == 0) ++sure_confusion_[toIndex(expected)][column];
    if (labels.patches[i] != scene_labeler::kNoPatch) patches[toIndex(expected)].insert(labels.patches[i]);
    if (answer == SceneClass::None) continue;
    const auto stated = static_cast<double>(labels.probability(i));
    Bin& bin = bins_[std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * stated))];
    ++bin.points;
    bin.right += answer == expected ? 1U : 0U;
    bin.stated += stated;
  }
  for (std::size_t k = 0; k < kClassCount; ++k) patches_[k] += patches[k].size();
}

std::size_t LabelScore::truthCount(std::size_t of_class) const {
  std::size_t count = 0;
  for (const std::size_t answers : confusion_[of_class]) count += answers;
  return count;
}

LabelScore::Pair LabelScore::pairAt(std::size_t of_class) const {
  std::size_t answered = 0;
  for (const auto& row : confusion_) answered += row[of_class];
  const std::size_t hits = confusion_[of_class][of_class];
  const double precision = shareOrZero(hits, answered), recall = shareOrZero(hits, truthCount(of_class));
  return {precision, recall, hits == 0 ? 0.0 : 2.0 * precision * recall / (precision + recall)};
}

double LabelScore::accuracy() const {
  std::size_t hits = 0;
  for (std::size_t k = 0; k < kClassCount; ++k) hits += confusion_[k][k];
  return shareOrZero(hits, points_);
}

double LabelScore::meanF1() const {
  double sum = 0.0, classes = 0.0;
  for (std::size_t k = 0; k < kClassCount; ++k) {
    if (truthCount(k) == 0) continue;
    sum += pairAt(k).f1;
    classes += 1.0;
  }
  return classes > 0.0 ? sum / classes : 0.0;
}

double LabelScore::calibrationError() const {
  double sum = 0.0, points = 0.0;
  for (const Bin& bin : bins_) {
    sum += std::abs(bin.stated - static_cast<double>(bin.right));
    points += static_cast<double>(bin.points);
  }
  return points > 0.0 ? sum / points : 0.0;
}

Json LabelScore::toJson(const Confusion& confusion) {
  Json names = Json::array(), rows = Json::array();
  for (std::size_t k = 0; k <= kClassCount; ++k) names.append(nameAt(k));
  for (const auto& answers : confusion) {
    Json row = Json::array();
    for (const std::size_t count : answers) row.append(count);
    rows.append(std::move(row));
  }
  return Json::object({{"names", std::move(names)}, {"rows", std::move(rows)}});
}

void LabelScore::addTo(Json& json) const {
  json["points"] = points_;
  json["accuracy"] = accuracy();
  json["f1_mean"] = meanF1();
  json["classes"] = Json::object();
  for (std::size_t k = 0; k < kClassCount; ++k) {
    if (truthCount(k) == 0) continue;
    const Pair pair = pairAt(k);
    json["classes"][nameAt(k)] = Json::object({{"points", truthCount(k)},
                                               {"patches", patches_[k]},
                                               {"precision", pair.precision},
                                               {"recall", pair.recall},
                                               {"f1", pair.f1}});
  }
  json["confusion"] = toJson(confusion_);
  json["sure_confusion"] = toJson(sure_confusion_);
  json["reliability"] = Json::array();
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const Bin& bin = bins_[i];
    const auto count = static_cast<double>(std::max<std::size_t>(bin.points, 1));
    json["reliability"].append(Json::object({{"from", static_cast<double>(i) / 10.0},
                                             {"to", static_cast<double>(i + 1) / 10.0},
                                             {"points", bin.points},
                                             {"stated", bin.stated / count},
                                             {"right", static_cast<double>(bin.right) / count}}));
  }
  json["calibration_error"] = calibrationError();
}

std::string LabelScore::print() const {
  std::string text = std::to_string(points_) + " points: accuracy " + percentText(accuracy()) + ", mean F1 " +
                     percentText(meanF1()) + ", calibration error " + percentText(calibrationError()) + "\n";
  for (std::size_t k = 0; k < kClassCount; ++k) {
    if (truthCount(k) == 0) continue;
    const Pair pair = pairAt(k);
    text += std::string(nameAt(k)) + ": " + std::to_string(truthCount(k)) + " points, precision " +
            percentText(pair.precision) + ", recall " + percentText(pair.recall) + ", F1 " + percentText(pair.f1) +
            "\n";
  }
  return text;
}

}  // namespace urban_nav
