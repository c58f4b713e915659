// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_drive.hpp"

#include <chrono>
#include <filesystem>

#include "scene_labeler/drive/drive_labeler.hpp"
#include "scene_labeler/labelling/superpixels.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::DriveFrame;
using scene_labeler::DriveLabeler;
using scene_labeler::DriveReturn;
using scene_labeler::DriveWindow;
using scene_labeler::SceneClass;
using scene_labeler::SceneLabels;
using urban_nav_core::StampNs;

namespace {

/// Limits per scene of a drive, which has many scenes.
constexpr scene_labeler::SamplingLimits kDriveLimits{150, 1500};
constexpr scene_labeler::SamplingLimits kVariantLimits{50, 0};
constexpr double kLoneStretch = 40.0;  // m along the path: the folds of a bag that is the only source

/// Times the labelling of frames.
class TimedLabeler final : public DriveLabeler {
 public:
  TimedLabeler(const scene_labeler::LabelModel& model, const scene_labeler::Parameters& parameters, TakeLabels take,
               LabelRun& run)
      : DriveLabeler(model, parameters, std::move(take)), run_(run) {}

  void observe(const DriveFrame& frame, const Stretch& nearest, std::size_t first,
               const std::vector<DriveReturn>& returns) override {
    const auto begin = std::chrono::steady_clock::now();
    DriveLabeler::observe(frame, nearest, first, returns);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    run_.seconds += seconds;
    run_.milliseconds.push_back(1e3 * seconds);
    run_.has_look = run_.has_look || !frame.view.image.empty();
    ++run_.frames;
  }

 private:
  LabelRun& run_;
};

/// Adds the scene of each frame to the training data.
class FoldBuilder final : public scene_labeler::DriveObserver {
 public:
  FoldBuilder(std::string fold, const DriveTruth& truth, scene_labeler::FeatureSet features, int superpixel,
              bool is_alone, std::vector<scene_labeler::TrainingFold>& folds)
      : fold_(std::move(fold)),
        is_alone_(is_alone),
        truth_(truth),
        features_(features),
        superpixel_(superpixel),
        folds_(folds) {}

  void observe(const DriveFrame& frame, const Stretch& nearest, std::size_t,
               const std::vector<DriveReturn>& returns) override {
    add(makeDriveScene(returns, frame.view), frame, nearest, returns, true, kDriveLimits);
    addVariant(frame, nearest, returns);
    ++frames_;
  }
  void settle(std::size_t) override {}

 private:
  /// Adds the scene as seen by other sensors: without reflectance, and alternately without image or thinned to a
  /// quarter. Not used for calibration.
  void addVariant(const DriveFrame& frame, const Stretch& nearest, const std::vector<DriveReturn>& returns) {
    const bool is_thinned = frames_ % 2 == 0, has_image = frames_ % 4 < 2;
    const scene_labeler::SideView view = has_image ? frame.view : scene_labeler::SideView();
    if (!is_thinned) return add(makeDriveScene(returns, view), frame, nearest, returns, false, kVariantLimits);
    const scene_labeler::DriveScene dense = makeDriveScene(returns, view);
    std::vector<DriveReturn> thinned;
    for (std::size_t i = 0; i < dense.first_of_point.size(); i += 4)
      thinned.push_back(returns[dense.first_of_point[i]]);
    add(makeDriveScene(thinned, view), frame, nearest, thinned, false, kVariantLimits);
  }

  void add(const scene_labeler::DriveScene& drive, const DriveFrame& frame, const Stretch& nearest,
           const std::vector<DriveReturn>& returns, bool with_reflectance,
           const scene_labeler::SamplingLimits& limits) {
    const std::vector<std::uint8_t> is_labelled = labelledPoints(drive, returns, nearest);
    scene_labeler::TrainingScene training;
    training.fold = is_alone_ ? fold_ + "/" + std::to_string(static_cast<int>(frame.travelled / kLoneStretch)) : fold_;
    for (std::size_t i = 0; i < drive.first_of_point.size(); ++i) {
      const DriveReturn& one = returns[drive.first_of_point[i]];
      training.labels.push_back(is_labelled[i] != 0 ? truth_.at(one.scan, one.beam) : SceneClass::None);
    }
    training.features = scene_labeler::measureFeatures(drive.scene, features_, with_reflectance);
    training.patches =
        scene_labeler::makePatches(drive.scene, scene_labeler::makeSuperpixels(drive.scene.view.image, superpixel_));
    scene_labeler::addScene(training, limits, folds_);
  }
  const std::string fold_;
  const bool is_alone_;
  const DriveTruth& truth_;
  const scene_labeler::FeatureSet features_;
  const int superpixel_;
  std::vector<scene_labeler::TrainingFold>& folds_;
  std::size_t frames_ = 0;
};

}  // namespace

DriveTruth::DriveTruth(const std::string& path, const scene_labeler::ClassMap& map) {
  const auto table = urban_nav_core::CsvTable::read(path);
  const std::size_t stamp = table.column("stamp_ns"), beam = table.column("beam"), label = table.column("class");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, label).empty()) continue;
    const std::int64_t number = table.integer(row, beam);
    if (number < 0 || number > 65535)
      throw urban_nav_core::UserError(table.where(row), "beam = " + std::to_string(number), "0...65535");
    std::vector<SceneClass>& scan = scans_[table.integer(row, stamp)];
    if (scan.size() <= static_cast<std::size_t>(number))
      scan.resize(static_cast<std::size_t>(number) + 1, SceneClass::None);
    scan[static_cast<std::size_t>(number)] = map.toClasses({table.integer(row, label)}, table.where(row)).front();
  }
}

std::string DriveTruth::path(const std::string& bag, DriveSide side) {
  const std::filesystem::path file(bag);
  return (file.parent_path() / (file.stem().string() + ".truth") / (std::string("laser_") + toString(side) + ".csv"))
      .string();
}

SceneClass DriveTruth::at(StampNs scan, std::uint16_t beam) const {
  const auto found = scans_.find(scan);
  return found == scans_.end() || beam >= found->second.size() ? SceneClass::None : found->second[beam];
}

void labelDrive(const scene_labeler::LabelModel& model, const std::string& bag, const DriveOptions& options,
                Console& console, const TakeDriveLabels& take, LabelRun& run) {
  const scene_labeler::Parameters& parameters = options.parameters->get(scene_labeler::table());
  const auto taker = [&](DriveSide side) {
    return [&, side](const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
      run.points += returns.size();
      run.labelled += returns.size();
      for (const std::uint8_t is_unsure : labels.unsure) run.unsure += is_unsure;
      take(side, returns, labels);
    };
  };
  TimedLabeler left(model, parameters, taker(DriveSide::Left), run);
  TimedLabeler right(model, parameters, taker(DriveSide::Right), run);
  DriveWindow left_window(parameters.projection_distance, left), right_window(parameters.projection_distance, right);
  readDrive(bag, options, console, {&left_window, &right_window});
  if (!parameters.class_topic.empty())
    console.info(bag + ": class images for " + std::to_string(left.classFrames() + right.classFrames()) + " of " +
                 std::to_string(left.imagedFrames() + right.imagedFrames()) + " images");
  run.new_place_frames += left.newPlaceFrames() + right.newPlaceFrames();
  for (const auto& [labeler, side] : {std::pair(&left, DriveSide::Left), std::pair(&right, DriveSide::Right)}) {
    if (labeler->upsideDownFrames() > 0)
      console.warn(bag + ": the " + toString(side) + " camera seems to be mounted upside down: " +
                   std::to_string(labeler->upsideDownFrames()) + " of its images are not used");
    if (labeler->blindFrames() > 0)
      console.warn(bag + ": " + std::to_string(labeler->blindFrames()) + " images of the " + toString(side) +
                   " camera are black or saturated and are not used");
  }
}

void addDriveFold(const std::string& bag, const DriveOptions& options, const scene_labeler::ClassMap& map,
                  scene_labeler::FeatureSet features, bool is_alone, Console& console,
                  std::vector<scene_labeler::TrainingFold>& folds) {
  const scene_labeler::Parameters& parameters = options.parameters->get(scene_labeler::table());
  const DriveTruth left_truth(DriveTruth::path(bag, DriveSide::Left), map),
      right_truth(DriveTruth::path(bag, DriveSide::Right), map);
  const std::string name = std::filesystem::path(bag).stem().string();
  std::vector<scene_labeler::TrainingFold> left_folds, right_folds;  // in an order independent of the messages
  FoldBuilder left(name, left_truth, features, parameters.superpixel, is_alone, left_folds),
      right(name, right_truth, features, parameters.superpixel, is_alone, right_folds);
  DriveWindow left_window(parameters.projection_distance, left), right_window(parameters.projection_distance, right);
  readDrive(bag, options, console, {&left_window, &right_window});
  for (std::vector<scene_labeler::TrainingFold>* made : {&left_folds, &right_folds})
    for (scene_labeler::TrainingFold& fold : *made) scene_labeler::mergeFold(std::move(fold), folds);
}

std::string printDriveHeader(const std::vector<SceneClass>& classes) {
  return "stamp_ns,beam,label,probability" + printClassColumns(classes) + ",unsure\n";
}

std::string printDriveLabels(const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
  std::string text;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    text += std::to_string(returns[i].scan) + "," + std::to_string(returns[i].beam);
    appendLabelCells(labels, i, text);
  }
  return text;
}

}  // namespace urban_nav
