// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_sweeps.hpp"

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>

#include "scene_labeler/model/place_novelty.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/planar_clouds.hpp"

namespace urban_nav {

using scene_labeler::SweepLabeler;
using scene_labeler::SweepLabels;
using urban_nav_core::LaserPoint;

namespace {

constexpr urban_nav_core::StampNs kLongestPoseGapOfBags = 500'000'000;  // as of the nodelet

/// Labels the sweeps of one bag.
class SweepRun {
 public:
  SweepRun(const scene_labeler::LabelModel& model, const urban_nav_core::Trajectory& T_odom_base, int superpixel,
           const TakeSweepLabels& take, LabelRun& run)
      : T_odom_base_(T_odom_base),
        labeler_(std::make_shared<const scene_labeler::LabelModel>(model), superpixel),
        take_(take),
        run_(run) {}

  void add(const urban_nav_input::SweepInput& input) {
    const urban_nav_core::BeamRenderer fresh(T_odom_base_, input.T_base_lidar, urban_nav_core::Pose(),
                                             kLongestPoseGapOfBags);
    std::vector<LaserPoint> returns;
    renderers_.try_emplace(input.role, fresh).first->second.render({input.sweep.reference, input.sweep.beams}, returns);
    ++sweeps_;
    if (returns.empty()) return;
    const auto begin = std::chrono::steady_clock::now();
    const SweepLabels labels = labeler_.label(returns, returns.back().origin);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    run_.seconds += seconds;
    run_.milliseconds.push_back(1e3 * seconds);
    ++run_.frames;
    ++labelled_;
    run_.new_place_frames += scene_labeler::isNewPlace(labels.answers.share_unlike) ? 1U : 0U;
    run_.points += returns.size();
    run_.labelled += labels.answered();
    for (const std::uint32_t row : labels.answer_of_return)
      run_.unsure += row != SweepLabels::kNoAnswer ? labels.answers.unsure[row] : 0U;
    take_(input.role, returns, labels);
  }

  std::size_t sweeps() const { return sweeps_; }
  std::size_t labelled() const { return labelled_; }

 private:
  const urban_nav_core::Trajectory& T_odom_base_;
  SweepLabeler labeler_;
  const TakeSweepLabels& take_;
  LabelRun& run_;
  std::map<std::string, urban_nav_core::BeamRenderer> renderers_;
  std::size_t sweeps_ = 0, labelled_ = 0;
};

}  // namespace

LabelledSensors findLabelledSensors(const std::string& bag, const std::vector<std::string>& topics) {
  using urban_nav_input::Role;
  urban_nav_input::Recording recording(bag);
  urban_nav_input::BagTopics chosen = urban_nav_input::chooseTopics(recording.topicTypes(), topics);
  const urban_nav_input::PlanarClouds planar(recording, {}, topics, chosen);  // which have the roles of scans then
  return {chosen.find(Role::LaserLeft) || chosen.find(Role::LaserRight), chosen.find(Role::Points0).has_value()};
}

void labelSweeps(const scene_labeler::LabelModel& model, const std::string& bag, const DriveOptions& options,
                 Console& console, const TakeSweepLabels& take, LabelRun& run) {
  const urban_nav_core::Trajectory T_odom_base = readDriveTrajectory(bag, options, console);
  urban_nav_input::SourceOptions source_options;
  source_options.topics = options.topics;
  source_options.with_sweeps = true;
  apply(options.parameters->get(urban_nav_input::inputTable()), source_options);
  const auto source = urban_nav_input::openSource({bag}, source_options);
  SweepRun sweeps(model, T_odom_base, options.parameters->get(scene_labeler::table()).superpixel, take, run);
  Progress progress(console, std::filesystem::path(bag).stem().string(), "sweeps", 0);
  const auto addAll = [&](const std::vector<urban_nav_input::SweepInput>& inputs) {
    for (const urban_nav_input::SweepInput& input : inputs)
      if (!input.is_planar) sweeps.add(input);
    progress.update(static_cast<std::int64_t>(sweeps.sweeps()));
  };
  while (const auto item = source->next()) {
    if (item->bag_end) addAll(item->bag_end->sweeps);
    addAll(item->sweeps);
  }
  if (source->bagEnd()) addAll(source->bagEnd()->sweeps);
  addAll(source->sweeps());
  progress.finish(static_cast<std::int64_t>(sweeps.sweeps()));
  if (sweeps.labelled() == 0)
    throw urban_nav_core::DataError(
        bag, "has no sweep within its trajectory (" + std::to_string(sweeps.sweeps()) + " sweeps of 3D LiDARs)",
        "a trajectory of the time of the bag");
  if (sweeps.labelled() < sweeps.sweeps())
    console.warn(bag + ": " + std::to_string(sweeps.sweeps() - sweeps.labelled()) + " of " +
                 std::to_string(sweeps.sweeps()) + " sweeps are not within the trajectory and have no labels");
}

std::string printSweepHeader(const std::vector<scene_labeler::SceneClass>& classes) {
  return "stamp_ns,x,y,z,label,probability" + printClassColumns(classes) + ",unsure\n";
}

std::string printSweepLabels(const std::vector<LaserPoint>& returns, const SweepLabels& labels) {
  std::string text;
  const std::string no_answer = ",255" + std::string(labels.answers.classes.size() + 2, ',') + "\n";
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const LaserPoint& one = returns[i];
    text += std::to_string(one.stamp);
    for (int k = 0; k < 3; ++k) text += "," + urban_nav_core::printNumber(one.p(k));
    const std::uint32_t row = labels.answer_of_return[i];
    if (row == SweepLabels::kNoAnswer) text += no_answer;
    else appendLabelCells(labels.answers, row, text);
  }
  return text;
}

}  // namespace urban_nav
