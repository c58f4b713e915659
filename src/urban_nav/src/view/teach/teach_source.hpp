// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/json.hpp"
#include "topics/labels/teach/correction_file.hpp"
#include "topics/labels/teach/scene_teacher.hpp"
#include "topics/labels/teach/teach_suggestions.hpp"
#include "view/page_events.hpp"
#include "view/teach/teach_words.hpp"

namespace urban_nav {

/// A scene, its answers, and the corrections that the page adds. Each correction is in the file before change()
/// returns; a thread then teaches the model and answers again, with all corrections that were made meanwhile.
/// Thread-safe.
class TeachSource {
 public:
  struct Setup {
    SceneFiles files;
    SceneInput input;
    scene_labeler::LabelModel model;
    std::string model_name, corrections;  ///< the latter: path of the file
    SceneTeacher::Options options;
    bool read_only = false;
  };

  /// Labels the scene, and reads the corrections if their file exists. `events` must outlive this object. Throws
  /// UserError for a scene without points, a model without samples, and a file of another scene.
  TeachSource(Setup setup, PageEvents& events);
  ~TeachSource();
  TeachSource(const TeachSource&) = delete;
  TeachSource& operator=(const TeachSource&) = delete;

  /// Returns names, classes, corrections, suggestions, and counts of the answers.
  std::string state();
  /// Returns per point: x, y, z (m, from `offset` of state()) as float32, then per point the number of its unit as
  /// uint32, then, with an image, per point its pixel u, v as float32, NaN if hidden; in little endian.
  std::string cloud() const;
  /// Returns per point: class, probability in 1/255, and 1 if unsure plus 2 if corrected, a byte each.
  std::string answers();
  /// Returns the image as JPEG; nullopt without one.
  std::optional<std::string> image() const;
  /// Adds a correction, or takes one back, and returns {"changed", "text"}. Throws UserError for a point without a unit
  /// and with --read-only, DataError if another program has changed the file.
  Json change(const TeachWords& words);
  /// Waits until the answers include all corrections. For tests.
  void waitForAnswers();

 private:
  void store();
  void teachInTurn();
  Json classesAsJson() const;
  Json correctionsAsJson() const;
  Json suggestionsAsJson() const;
  Json countsAsJson() const;
  Json placeAsJson(std::uint32_t point) const;

  const SceneFiles files_;
  const Eigen::Vector3d offset_;
  const std::string model_name_;
  const bool read_only_;
  const SceneTeacher teacher_;
  const TeachUnits units_;
  const UnitKinds kinds_;
  const CorrectionFile file_;
  PageEvents& events_;

  std::mutex mutex_;  ///< guards the following members
  std::condition_variable wanted_;
  CorrectionList corrections_;
  std::vector<scene_labeler::SceneClass> corrected_;  ///< per point
  scene_labeler::SceneLabels answer_;
  std::vector<TeachSuggestion> suggestions_;
  std::string file_state_;  ///< as last read or written
  std::string fault_;       ///< of the last attempt to teach
  std::size_t changes_ = 0, answered_ = 0;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace urban_nav
