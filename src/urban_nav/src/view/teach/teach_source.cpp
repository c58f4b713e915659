// SPDX-License-Identifier: BSD-3-Clause
#include "view/teach/teach_source.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;
using scene_labeler::SceneLabels;
using urban_nav_core::appendLittleEndian;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kMostSuggestions = 12;

/// Returns a text that changes when the file of corrections is written.
std::string correctionsState(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return "";
  return std::to_string(file.st_ino) + " " + std::to_string(file.st_size) + " " + std::to_string(file.st_mtim.tv_sec) +
         "." + std::to_string(file.st_mtim.tv_nsec);
}

/// Returns the scene. Throws DataError if it has no points.
const scene_labeler::Scene& sceneWithPoints(const TeachSource::Setup& setup) {
  const std::vector<Eigen::Vector3f>& points = setup.input.scene.points;
  if (std::none_of(points.begin(), points.end(), [](const Eigen::Vector3f& p) { return p.allFinite(); }))
    throw urban_nav_core::DataError(setup.files.points, "has no points", "a cloud with points");
  return setup.input.scene;
}

std::string sizeText(std::size_t points) { return std::to_string(points) + (points == 1 ? " point" : " points"); }

}  // namespace

TeachSource::TeachSource(Setup setup, PageEvents& events)
    : files_(setup.files),
      offset_(setup.input.offset),
      model_name_(setup.model_name),
      read_only_(setup.read_only),
      teacher_(std::move(setup.model), setup.model_name, sceneWithPoints(setup), setup.options),
      units_(teacher_.scene(), setup.options.training.superpixel),
      kinds_(units_, teacher_.features(), teacher_.base().bins),
      file_(setup.corrections, files_, setup.input, setup.options.training.superpixel),
      events_(events) {
  if (file_.exists()) corrections_ = file_.read(units_);
  file_state_ = correctionsState(file_.path());
  corrected_ = corrections_.labels(units_);
  answer_ = teacher_.answer(corrected_);
  suggestions_ = suggestCorrections(units_, kinds_, answer_, corrections_.active(), corrected_, kMostSuggestions);
  thread_ = urban_nav_core::namedThread("teaching", [this] { teachInTurn(); });
}

TeachSource::~TeachSource() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    wanted_.notify_all();
  }
  thread_.join();
}

void TeachSource::teachInTurn() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wanted_.wait(lock, [this] { return is_ending_ || changes_ != answered_; });
    if (is_ending_) return;
    const std::size_t change = changes_;
    const std::vector<SceneClass> corrected = corrected_;
    const std::vector<LabelCorrection> active = corrections_.active();
    lock.unlock();
    std::string fault;
    std::optional<SceneLabels> answer;
    std::vector<TeachSuggestion> suggestions;
    try {
      answer = teacher_.answer(corrected);
      suggestions = suggestCorrections(units_, kinds_, *answer, active, corrected, kMostSuggestions);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    lock.lock();
    answered_ = change;
    fault_ = fault;
    if (answer) {
      answer_ = std::move(*answer);
      suggestions_ = std::move(suggestions);
    }
    if (changes_ == answered_) events_.finish(fault.empty() ? "The model has answered again." : fault, true);
    else events_.changed();
    wanted_.notify_all();
  }
}

void TeachSource::waitForAnswers() {
  std::unique_lock lock(mutex_);
  wanted_.wait(lock, [this] { return changes_ == answered_; });
}

void TeachSource::store() {
  if (correctionsState(file_.path()) != file_state_)
    throw urban_nav_core::DataError(file_.path(), "was changed by another program",
                                    "one program that writes it; start `labels teach` again to continue from it");
  file_.write(corrections_, units_);
  file_state_ = correctionsState(file_.path());
}

Json TeachSource::change(const TeachWords& words) {
  if (read_only_) throw UserError("labels teach", "a correction of what --read-only shows", "no corrections");
  const std::lock_guard lock(mutex_);
  const CorrectionList before = corrections_;
  bool changed = true;
  std::string text;
  if (words.action == TeachWords::Action::Correct) {
    const std::vector<std::uint32_t> units = units_.near(words.correction.point, words.correction.radius);
    if (units.empty())
      throw UserError("point", std::to_string(words.correction.point) + " has no unit",
                      "a finite point of " + std::to_string(units_.points()));
    corrections_.add(words.correction);
    std::size_t points = 0;
    for (const std::uint32_t unit : units) points += units_.count(unit);
    text = std::string(toString(words.correction.label)) + ": " + sizeText(points);
  } else {
    const bool is_undo = words.action == TeachWords::Action::Undo;
    changed = is_undo ? corrections_.undo() : corrections_.redo();
    text = changed ? (is_undo ? "The last correction is undone." : "The correction is restored.")
                   : (is_undo ? "There is no correction to undo." : "There is no correction to restore.");
  }
  if (!changed) return Json::object({{"changed", false}, {"text", text}});
  try {
    store();
  } catch (const urban_nav_core::Error&) {
    corrections_ = before;
    throw;
  }
  corrected_ = corrections_.labels(units_);
  ++changes_;
  events_.begin("the model answers again");
  wanted_.notify_all();
  return Json::object({{"changed", true}, {"text", text}});
}

std::string TeachSource::cloud() const {
  const scene_labeler::Scene& scene = teacher_.scene();
  std::string bytes;
  bytes.reserve(scene.points.size() * 24);
  for (const Eigen::Vector3f& p : scene.points)
    for (int k = 0; k < 3; ++k) appendLittleEndian(bytes, p[k]);
  for (const std::uint32_t unit : units_.unitNumbers()) appendLittleEndian(bytes, unit);
  if (scene.view.image.empty()) return bytes;
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    for (int k = 0; k < 2; ++k)
      appendLittleEndian(
          bytes, scene.view.is_visible[i] != 0 ? scene.view.pixels[i][k] : std::numeric_limits<float>::quiet_NaN());
  return bytes;
}

std::string TeachSource::answers() {
  const std::lock_guard lock(mutex_);
  std::string bytes;
  bytes.reserve(3 * corrected_.size());
  for (std::size_t i = 0; i < corrected_.size(); ++i) {
    const bool is_corrected = corrected_[i] != SceneClass::None;
    const SceneClass label = is_corrected ? corrected_[i] : answer_.labels[i];
    const double probability = is_corrected                ? 1.0
                               : label == SceneClass::None ? 0.0
                                                           : static_cast<double>(answer_.probability(i));
    const int flags = (!is_corrected && answer_.unsure[i] != 0 ? 1 : 0) | (is_corrected ? 2 : 0);
    for (const int value : {static_cast<int>(label), static_cast<int>(std::lround(255.0 * probability)), flags})
      appendLittleEndian(bytes, static_cast<std::uint8_t>(value));
  }
  return bytes;
}

std::optional<std::string> TeachSource::image() const {
  const cv::Mat& image = teacher_.scene().view.image;
  if (image.empty()) return std::nullopt;
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg);
  return std::string(jpeg.begin(), jpeg.end());
}

}  // namespace urban_nav
