// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_clicks.hpp"

#include <algorithm>
#include <filesystem>

#include "scene_labeler/drive/drive_labeler.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::DriveFrame;
using scene_labeler::DriveReturn;
using urban_nav_core::UserError;

/// Adds the clicked superpixels of one side of a bag, frame by frame.
class LabelClicks::Collector final : public scene_labeler::DriveObserver {
 public:
  Collector(const std::vector<Click>& clicks, const scene_labeler::LabelModel& model, int superpixel,
            scene_labeler::TrainingFold& fold)
      : clicks_(clicks), is_found_(clicks.size(), false), model_(model), superpixel_(superpixel), fold_(fold) {}

  void observe(const DriveFrame& frame, const Stretch& nearest, std::size_t,
               const std::vector<DriveReturn>& returns) override {
    std::vector<std::pair<std::size_t, std::size_t>> here;  // click, return
    for (std::size_t i = 0; i < returns.size(); ++i)
      for (std::size_t click = 0; click < clicks_.size(); ++click)
        if (returns[i].scan == clicks_[click].scan && returns[i].beam == clicks_[click].beam)
          here.emplace_back(click, i);
    if (here.empty()) return;
    const scene_labeler::DriveScene drive = makeDriveScene(returns, frame.view);
    const std::vector<std::uint8_t> is_labelled = labelledPoints(drive, returns, nearest);
    std::vector<scene_labeler::PatchCorrection> corrections;
    for (const auto& [click, one] : here) {
      is_found_[click] = true;
      const std::size_t point = drive.point_of_return[one];
      if (is_labelled[point] != 0) corrections.push_back({point, clicks_[click].label});
    }
    added_ += scene_labeler::addPatchCorrections(model_, drive.scene, corrections, superpixel_, fold_);
  }
  void settle(std::size_t) override {}

  std::size_t added() const { return added_; }
  /// Throws UserError for a click on a return that is not in the bag.
  void requireAllFound(const std::string& bag) const {
    for (std::size_t click = 0; click < clicks_.size(); ++click)
      if (!is_found_[click])
        throw UserError(clicks_[click].where, "a return that " + bag + " does not have",
                        "stamp_ns and beam of laser_left_labels.csv or laser_right_labels.csv");
  }

 private:
  const std::vector<Click>& clicks_;
  std::vector<bool> is_found_;
  const scene_labeler::LabelModel& model_;
  const int superpixel_;
  scene_labeler::TrainingFold& fold_;
  std::size_t added_ = 0;
};

LabelClicks::ClickedBag& LabelClicks::bagOf(const std::string& bag, const std::string& trajectory,
                                            const std::string& where) {
  const auto found = std::find_if(bags_.begin(), bags_.end(), [&](const ClickedBag& one) { return one.bag == bag; });
  if (found == bags_.end()) return bags_.emplace_back(ClickedBag{bag, trajectory, {}});
  if (found->trajectory != trajectory) throw UserError(where, "trajectory = " + trajectory, found->trajectory);
  return *found;
}

LabelClicks::LabelClicks(const std::string& path) {
  const auto table = urban_nav_core::CsvTable::read(path);
  const std::size_t bag = table.column("bag"), side = table.column("side"), stamp = table.column("stamp_ns"),
                    beam = table.column("beam"), label = table.column("class");
  const auto fromFolder = [&](const std::string& name) {
    return name.empty() ? name : (std::filesystem::path(path).parent_path() / name).string();
  };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& side_name = table.text(row, side);
    if (side_name != "left" && side_name != "right")
      throw UserError(table.where(row), "side = " + side_name, "left, right");
    const auto known = scene_labeler::classFromName(table.text(row, label));
    if (!known) throw UserError(table.where(row), "class = " + table.text(row, label), scene_labeler::classNames());
    const std::int64_t number = table.integer(row, beam);
    if (number < 0 || number > 65535)
      throw UserError(table.where(row), "beam = " + std::to_string(number), "0...65535");
    const std::string trajectory = table.has("trajectory") ? table.text(row, table.column("trajectory")) : "";
    ClickedBag& clicked = bagOf(fromFolder(table.text(row, bag)), fromFolder(trajectory), table.where(row));
    clicked.clicks[side_name == "left" ? 0 : 1].push_back(
        {table.integer(row, stamp), static_cast<std::uint16_t>(number), *known, table.where(row)});
    ++count_;
  }
}

std::size_t LabelClicks::addTo(const scene_labeler::LabelModel& model, const DriveOptions& options, Console& console,
                               scene_labeler::TrainingFold& fold) const {
  const scene_labeler::Parameters& parameters = options.parameters->get(scene_labeler::table());
  std::size_t added = 0;
  for (const ClickedBag& clicked : bags_) {
    if (!std::filesystem::exists(clicked.bag))
      throw UserError(clicked.bag, "does not exist", "the bags named in the file of clicks");
    std::array<scene_labeler::TrainingFold, kBothSides.size()> folds;  // in an order independent of the messages
    Collector left(clicked.clicks[0], model, parameters.superpixel, folds[0]),
        right(clicked.clicks[1], model, parameters.superpixel, folds[1]);
    scene_labeler::DriveWindow left_window(parameters.projection_distance, left),
        right_window(parameters.projection_distance, right);
    DriveOptions drive = options;
    drive.trajectory = clicked.trajectory;
    readDrive(clicked.bag, drive, console, {&left_window, &right_window});
    for (const Collector* collector : {&left, &right}) {
      collector->requireAllFound(clicked.bag);
      added += collector->added();
    }
    std::vector<scene_labeler::TrainingFold> merged = {std::move(fold)};
    for (scene_labeler::TrainingFold& side : folds) {
      side.name = merged.front().name;
      scene_labeler::mergeFold(std::move(side), merged);
    }
    fold = std::move(merged.front());
  }
  return added;
}

}  // namespace urban_nav
