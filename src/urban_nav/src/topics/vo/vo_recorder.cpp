// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "pose_graph/level.hpp"
#include "swf_vo/parameters.hpp"
#include "topics/vo/track_picture.hpp"
#include "topics/vo/vo.hpp"
#include "topics/vo/vo_run_state.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav {

using swf_vo::Feature;
using swf_vo::Frame;
using urban_nav_core::Health;
using urban_nav_core::ImageView;

namespace {

constexpr std::size_t kPictures = 8;
constexpr std::size_t kTail = 6;  // frames of the drawn track of a feature

constexpr const char* kStateName = "visual odometry of a session";
constexpr std::uint32_t kStateVersion = 2;

std::uint8_t greyAt(const ImageView& image, const Eigen::Vector3d& pixel) {
  const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
  return image.empty() || u < 0 || v < 0 || u >= image.width || v >= image.height ? std::uint8_t{0} : image.at(u, v);
}

/// Sets the description of the input, which is not part of any state.
VoRun& describeInput(VoRun& run, const urban_nav_input::SourceInfo& info) {
  run.input = info.name;
  run.camera = info.camera;
  run.T_base_camera = info.T_base_camera;
  return run;
}

urban_nav_core::FrameMeasurements toMeasurements(const Frame& frame, urban_nav_core::StampNs stamp) {
  urban_nav_core::FrameMeasurements measured;
  measured.stamp = stamp;
  measured.right_turn = frame.rig.right_turn_rad;
  if (!frame.accepted) return measured;
  measured.disparity_step_px = frame.statistics.disparity_step.px;
  measured.disparity_step_sigma_px = frame.statistics.disparity_step.sigma_px;
  measured.reprojection_px = frame.statistics.reprojection_px;
  const swf_vo::MotionComparison& compared = frame.motion.newest;
  measured.turn = compared.turn;
  measured.turn_error = compared.turn_error;
  measured.turn_sigma = compared.turn_sigma;
  measured.forward = compared.forward;
  measured.sideways = compared.sideways;
  measured.forward_error = compared.forward_error;
  measured.forward_sigma = compared.forward_sigma;
  measured.gyroscope_fault = currentFault(frame.motion, false);
  measured.wheels_fault = currentFault(frame.motion, true);
  if (frame.motion.has_gyroscope) {
    measured.imu_delay = frame.motion.imu_offset_s;
    measured.imu_delay_sigma = frame.motion.imu_offset_sigma_s;
  }
  if (frame.motion.has_wheels) {
    measured.wheel_delay = frame.motion.wheel_offset_s;
    measured.wheel_delay_sigma = frame.motion.wheel_offset_sigma_s;
  }
  return measured;
}

std::string caption(const OdometryFrame& frame, const swf_vo::Statistics& statistics) {
  std::string text =
      std::to_string(statistics.features) + " features, " + std::to_string(statistics.tracked) + " tracked";
  if (frame.status.health != Health::Ok)
    text += ", " + std::string(toString(frame.status.health)) + ": " + frame.status.sentence;
  return text;
}

SmoothedFrame toSmoothedFrame(const swf_vo::Settled& settled) {
  return {settled.frame, settled.stamp, settled.T_odom_base, settled.from_previous, settled.status};
}

/// Returns the rotation after which `odom` has z opposite to gravity and the first pose has heading zero; nullopt if
/// the specific forces of the session do not determine it.
std::optional<Eigen::Quaterniond> findOdometryLevel(const VoRun& run) {
  if (run.settled.empty() || run.forces.empty()) return std::nullopt;
  const pose_graph::Level level = pose_graph::estimateLevel(smoothedTrajectory(run), run.forces);
  if (!level.known()) return std::nullopt;
  const Eigen::Quaterniond q_odom_first = run.settled.front().T_odom_base.pose.q();
  return (Eigen::Quaterniond(level.R_map_first) * q_odom_first.conjugate()).normalized();
}

}  // namespace

/// Keeps a few pictures evenly spread over a session of unknown length: doubles the step between them when there are
/// too many.
class VoRecorder::PictureKeeper {
 public:
  void add(const OdometryFrame& frame, const swf_vo::Statistics& statistics, const ImageView& image,
           const std::vector<Feature>& features, std::vector<VoPicture>& pictures) {
    tails_.push_back(features);
    if (tails_.size() > kTail) tails_.erase(tails_.begin());
    if (frame.frame == 0 || frame.frame % step_ != 0 || image.empty()) return;
    VoPicture picture = drawTracks(image, tails_);
    picture.frame = frame.frame;
    picture.stamp = frame.stamp;
    picture.caption = caption(frame, statistics);
    pictures.push_back(std::move(picture));
    if (pictures.size() <= kPictures) return;
    step_ *= 2;
    pictures.erase(
        std::remove_if(pictures.begin(), pictures.end(), [this](const VoPicture& p) { return p.frame % step_ != 0; }),
        pictures.end());
  }

  void archive(urban_nav_core::Archive& archive) {
    archive(step_, tails_);
    archive.require(step_ > 0, "no step between pictures");
  }

 private:
  std::int64_t step_ = 4;
  std::vector<std::vector<Feature>> tails_;  // the newest last
};

VoRecorder::VoRecorder(const swf_vo::Parameters& parameters, const urban_nav_input::SourceInfo& info, VoRun& run)
    : run_(describeInput(run, info)),
      filter_(std::in_place, parameters, info.camera, info.T_base_camera),
      turns_(info.camera),
      pictures_(std::make_unique<PictureKeeper>()) {}

VoRecorder::VoRecorder(const swf_vo::Parameters& parameters, const urban_nav_input::SourceInfo& info, VoRun& run,
                       std::string_view state)
    : VoRecorder(parameters, info, run) {
  const std::string where = std::string("state of ") + kStateName;
  urban_nav_core::Archive archive(urban_nav_core::unseal(kStateName, kStateVersion, state), where);
  std::string packed_run, filter;
  archive(packed_run, filter, *pictures_);
  archive.finish();
  std::optional<VoRun> found = unpackVoRun(packed_run);
  if (!found) throw urban_nav_core::DataError(where, "is damaged: its frames cannot be read", "");
  run_ = std::move(*found);
  describeInput(run_, info);
  filter_.emplace(parameters, info.camera, info.T_base_camera, filter);
}

VoRecorder::~VoRecorder() = default;

const OdometryFrame& VoRecorder::process(const urban_nav_input::SourceItem& input) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const Frame& frame = filter_->process(input.assembled.pair, input.assembled.inputs);
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();

  OdometryFrame row;
  row.frame = static_cast<std::int64_t>(run_.frames.size());
  row.stamp = input.assembled.pair.stamp;
  row.accepted = frame.accepted;
  row.status = frame.status;
  row.T_odom_base = frame.T_odom_base.pose;
  row.compared = toMeasurements(frame, row.stamp);
  if (frame.accepted) {
    run_.rig = frame.rig;
    run_.motion = frame.motion;
  }
  run_.faults_total += static_cast<std::int64_t>(input.faults.size());
  for (const std::string& fault : input.faults) {
    if (run_.faults.size() < kMaxFaults) run_.faults.push_back(fault);
  }
  for (const swf_vo::Settled& settled : frame.settled) run_.settled.push_back(toSmoothedFrame(settled));
  for (const swf_vo::Landmark& landmark : frame.landmarks) run_.landmarks[landmark.id].landmark = landmark;
  for (const Feature& feature : frame.features) {
    const auto known = run_.landmarks.find(feature.landmark);
    if (known == run_.landmarks.end()) continue;
    known->second.seen = feature.age + 1;
    known->second.grey = greyAt(input.assembled.pair.left, feature.pixel);
  }
  pictures_->add(row, frame.statistics, input.assembled.pair.left, frame.features, run_.pictures);
  run_.frames.push_back(std::move(row));
  run_.figures.push_back({frame.statistics, ms});
  return run_.frames.back();
}

void VoRecorder::correctRight(urban_nav_core::StereoPairWithMotion& frame) {
  turns_.add({frame.pair.stamp, run_.rig.right_turn_rad});
  turns_.correct(frame);
}

std::string VoRecorder::state() const {
  urban_nav_core::Archive archive;
  std::string run = packVoRun(run_), filter = filter_->state();
  archive(run, filter, *pictures_);
  return urban_nav_core::seal(kStateName, kStateVersion, archive.take());
}

bool VoRecorder::finish(const PassEnd& end, bool is_levelled) {
  run_.faults.insert(run_.faults.begin(), end.faults.begin(), end.faults.end());
  run_.faults_total += static_cast<std::int64_t>(end.faults.size());
  for (const swf_vo::Settled& settled : filter_->flush()) run_.settled.push_back(toSmoothedFrame(settled));
  std::vector<urban_nav_core::StampNs> stamps;
  for (const SmoothedFrame& settled : run_.settled) stamps.push_back(settled.stamp);
  run_.forces = pose_graph::forcesAt(stamps, end.forces);
  // If the gyroscope is wrong, so may be axes, units and stamps of the accelerometer.
  const std::optional<Eigen::Quaterniond> q_level_odom =
      is_levelled && !run_.motion.gyroscope_left_out ? findOdometryLevel(run_) : std::nullopt;
  if (!q_level_odom) return false;
  turnOdometry(*q_level_odom, run_);
  for (auto& [id, landmark] : run_.landmarks) landmark.landmark.p_odom = *q_level_odom * landmark.landmark.p_odom;
  return true;
}

urban_nav_core::Trajectory runOdometry(urban_nav_input::Source& source, const ParameterSet& parameters,
                                       Console& console) {
  VoRun run;
  VoRecorder recorder(parameters.get(swf_vo::table()), source.info(), run);
  Progress progress(console, "vo", "frames", source.info().frames);
  while (const auto item = source.next()) {
    recorder.process(*item);
    progress.update(static_cast<std::int64_t>(run.frames.size()));
  }
  progress.finish(static_cast<std::int64_t>(run.frames.size()));
  std::vector<std::string> faults = source.closingFaults();
  for (const urban_nav_input::Finding& finding : source.sensorFindings())
    faults.push_back(source.info().name + ": " + finding.text + " (" + finding.remedy + ")");
  for (const std::string& fault : faults) console.warn(fault);
  const bool uses_imu =
      urban_nav_core::toMotionChoice(parameters.get(urban_nav_input::inputTable()).motion_input).gyroscope;
  recorder.finish({faults, source.forces()}, uses_imu);
  return smoothedTrajectory(run);
}

}  // namespace urban_nav
