// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_labels.hpp"

#include <cmath>

namespace scene_labeler {

using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kMostWaitingScans = 4000, kMostWaitingImages = 40;  // per side
constexpr std::size_t kMostWaitingClasses = 40;                           // per side
constexpr StampNs kOdometryPatience = 60'000'000'000;  // ns of scans of a new drive that wait for its odometry
constexpr double kClassPatience = 2.0;                 // s of odometry to wait for the class image of an image
constexpr double kCameraPatience = 2.0;                // s of scans to wait for the calibration of a camera

StampNs scanEnd(const urban_nav_core::PlanarScan& scan) {
  const double seconds = scan.time_step * static_cast<double>(scan.ranges.size());
  return scan.stamp + static_cast<StampNs>(std::llround(1e9 * std::max(seconds, 0.0)));
}

std::shared_ptr<const LabelModel> shareWithPrecision(LabelModel model, double precision) {
  return std::make_shared<const LabelModel>(withPrecision(std::move(model), precision));
}

}  // namespace

LiveLabels::LiveLabels(const Parameters& parameters, LabelModel model, Outputs outputs)
    : parameters_(parameters),
      model_(shareWithPrecision(std::move(model), parameters.precision)),
      teaching_(parameters, model_),
      outputs_(std::move(outputs)),
      sweeps_(trajectory_, outputs_.sweep) {
  reset();
}

void LiveLabels::reset() {
  clear();
  counts_ = {};
  sweeps_.forgetCounts();
  sortByRound();
}

void LiveLabels::sortByRound() {
  urban_nav_live::RoundGate<Add>::Options options;
  options.leading = {kOdometryStream};
  options.patience = kOdometryPatience;
  rounds_ = std::make_unique<urban_nav_live::RoundGate<Add>>(
      options, urban_nav_live::RoundGate<Add>::Listener{[](Add& add) { add(); }, [this] { beginDrive(); }});
}

void LiveLabels::beginDrive() {
  for (LiveSide& side : sides_) {
    if (side.window) side.window->finish();
    count(side, counts_);
  }
  clear();
  ++counts_.drives;
}

void LiveLabels::clear() {
  for (LiveSide& side : sides_) {
    side.drive.reset();
    side.window.reset();
    side.labeler.reset();
    side.scans.clear();
    side.images.clear();
    side.classes.clear();
  }
  sweeps_.clear();
  path_.reset();
  trajectory_ = {};
  path_ = std::make_unique<TravelledPath>(trajectory_);
  teaching_.forgetScenes();
}

bool LiveLabels::adoptTaughtModel() {
  std::optional<LabelModel> taught = teaching_.takeTaught();
  if (!taught) return false;
  for (LiveSide& side : sides_) {
    if (side.window) side.window->finish();
    count(side, counts_);
    side.drive.reset();
    side.window.reset();
    side.labeler.reset();
  }
  sweeps_.clear();
  model_ = shareWithPrecision(std::move(*taught), parameters_.precision);
  return true;
}

void LiveLabels::addPose(const urban_nav_core::StampedPose& T_odom_base) {
  rounds_->add(kOdometryStream, T_odom_base.stamp, [this, T_odom_base] { take(T_odom_base); });
}

void LiveLabels::take(const urban_nav_core::StampedPose& T_odom_base) {
  if (!trajectory_.append(T_odom_base.stamp, T_odom_base.pose)) return;
  ++counts_.poses;
  path_->update();
  for (std::size_t side = 0; side < sides_.size(); ++side) work(side);
}

void LiveLabels::catchUp() {
  if (trajectory_.empty()) return;
  for (std::size_t side = 0; side < sides_.size(); ++side) work(side);
}

void LiveLabels::addScan(std::size_t side, urban_nav_core::PlanarScan scan) {
  ++counts_.scans;
  const StampNs stamp = scan.stamp;
  rounds_->add(kScanStream + static_cast<int>(side), stamp, [this, side, scan = std::move(scan)] { take(side, scan); });
}

void LiveLabels::take(std::size_t side, const urban_nav_core::PlanarScan& scan) {
  sides_[side].scans.push_back(scan);
  if (sides_[side].scans.size() > kMostWaitingScans) {
    sides_[side].scans.pop_front();
    ++counts_.dropped;
  }
}

void LiveLabels::addSweep(const std::string& frame, urban_nav_core::Sweep sweep) {
  const StampNs stamp = sweep.reference;
  rounds_->add(kSweepStream, stamp,
               [this, frame, sweep = std::move(sweep)]() mutable { sweeps_.add(frame, std::move(sweep)); });
}

void LiveLabels::addImage(std::size_t side, StampNs stamp, Decode decode) {
  ++counts_.images;
  rounds_->add(kImageStream + static_cast<int>(side), stamp, [this, side, stamp, decode = std::move(decode)] {
    sides_[side].images.push_back({stamp, decode});
    if (sides_[side].images.size() <= kMostWaitingImages) return;
    sides_[side].images.pop_front();
    ++counts_.dropped;
  });
}

void LiveLabels::addClasses(std::size_t side, StampNs stamp, const cv::Mat& classes) {
  rounds_->add(kClassStream + static_cast<int>(side), stamp, [this, side, stamp, classes] {
    sides_[side].classes[stamp] = classes;
    if (sides_[side].classes.size() > kMostWaitingClasses) sides_[side].classes.erase(sides_[side].classes.begin());
  });
}

bool LiveLabels::workImages(LiveSide& side) {
  const StampNs known = trajectory_.back().stamp;
  while (!side.images.empty() && side.images.front().stamp <= known) {
    const WaitingImage& image = side.images.front();
    if (side.drive->wants(image.stamp)) {
      const auto classes = side.classes.find(image.stamp);
      const bool may_come = !parameters_.class_topic.empty() && classes == side.classes.end() &&
                            urban_nav_core::secondsBetween(image.stamp, known) < kClassPatience;
      if (may_come) return false;
      side.drive->add(image.stamp, image.decode(), classes == side.classes.end() ? cv::Mat() : classes->second);
    }
    side.classes.erase(side.classes.begin(), side.classes.upper_bound(image.stamp));
    side.images.pop_front();
  }
  return true;
}

void LiveLabels::start(std::size_t number) {
  LiveSide& side = sides_[number];
  side.labeler = std::make_unique<DriveLabeler>(
      *model_, parameters_, outputs_.cloud,
      [this, number](const DriveFrame& frame, const cv::Mat& classes) { outputs_.image(number, frame, classes); },
      [this](DriveScene drive) { teaching_.keep(std::move(drive)); });
  side.window = std::make_unique<DriveWindow>(parameters_.projection_distance, *side.labeler);
  side.drive = std::make_unique<SideDrive>(SideRig{*side.T_base_laser, side.camera}, trajectory_, *path_,
                                           parameters_.spacing, *side.window);
}

void LiveLabels::work(std::size_t number) {
  LiveSide& side = sides_[number];
  if (!side.T_base_laser || side.scans.empty()) return;
  if (!side.drive) {
    const bool may_come = !side.camera && urban_nav_core::secondsBetween(side.scans.front().stamp,
                                                                         side.scans.back().stamp) < kCameraPatience;
    if (may_come) return;
    start(number);
  }
  if (!workImages(side)) return;
  const StampNs known = trajectory_.back().stamp;
  while (!side.scans.empty() && scanEnd(side.scans.front()) <= known) {
    side.drive->add(side.scans.front());
    side.scans.pop_front();
  }
}

void LiveLabels::Counts::addTo(urban_nav_live::StageReport& report) const {
  report.add("scans", scans);
  report.add("images", images);
  report.add("poses of odometry", poses);
  report.add("scans and images dropped without odometry", dropped);
  report.add("frames labelled", frames);
  report.add("of these with an image", imaged_frames);
  report.add("of these with a class image", class_frames);
  report.add("of these in a kind of place without training data", new_place_frames);
  report.add("black or saturated images", blind_frames);
  report.add("drives", drives);
  report.add("sweeps", sweeps.sweeps);
  report.add("sweeps labelled", sweeps.labelled);
  report.add("sweeps in a kind of place without training data", sweeps.new_place);
  report.add("sweeps dropped, faster than they are labelled", sweeps.too_many);
  report.add("sweeps dropped without odometry", sweeps.unplaced);
  report.add("time of the last sweep (ms)", sweeps.last_ms);
}

LiveLabels::Counts LiveLabels::counts() const {
  Counts counts = counts_;
  counts.dropped += static_cast<std::size_t>(rounds_->dropped());
  counts.sweeps = sweeps_.counts();
  for (const LiveSide& side : sides_) count(side, counts);
  return counts;
}

void LiveLabels::count(const LiveSide& side, Counts& counts) const {
  if (!side.labeler) return;
  counts.frames += side.labeler->frames();
  counts.imaged_frames += side.labeler->imagedFrames();
  counts.blind_frames += side.labeler->blindFrames();
  counts.upside_down_frames += side.labeler->upsideDownFrames();
  counts.new_place_frames += side.labeler->newPlaceFrames();
  counts.class_frames += side.labeler->classFrames();
}

}  // namespace scene_labeler
