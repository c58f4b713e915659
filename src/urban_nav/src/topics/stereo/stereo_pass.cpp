// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/stereo_pass.hpp"

#include <algorithm>
#include <cmath>

#include "map/state_bytes.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_store::TableStore;

namespace {

constexpr const char* kStereoRunName = "dense stereo of a session";
constexpr std::uint32_t kStereoRunVersion = 1;
constexpr std::size_t kPicturedKeyframes = 8;

urban_nav_registration::Parameters toSelection(const dense_stereo::Parameters& parameters) {
  urban_nav_registration::Parameters selection;
  selection.keyframe_distance = parameters.keyframe_distance;
  selection.keyframe_angle = parameters.keyframe_angle;
  return selection;
}

}  // namespace

StereoKeyframeSelector::StereoKeyframeSelector(const dense_stereo::Parameters& parameters)
    : selector_(toSelection(parameters)),
      interval_(static_cast<StampNs>(std::llround(parameters.keyframe_interval * 1e9))) {}

void StereoKeyframeSelector::keep(StampNs stamp, const Pose& T_odom_base) {
  selector_.keep(T_odom_base);
  last_ = stamp;
}

bool StereoKeyframeSelector::select(StampNs stamp, const Pose& T_odom_base) {
  if (last_ && stamp - *last_ < interval_) return false;
  if (!selector_.select(T_odom_base)) return false;
  last_ = stamp;
  return true;
}

StereoPass::StereoPass(MapContext& context, const Stage::SessionStart& start, StereoRun& run)
    : store_(*context.store),
      run_(run),
      selector_(context.options.parameters.get(dense_stereo::table())),
      matcher_(context.options.parameters.get(dense_stereo::table()), context.sessions[start.session].info,
               context.sessions[start.session].id, context.options.threads == 1) {
  run_ = start.checkpoint ? unpackStereoRun(*start.checkpoint) : StereoRun();
  selected_ = static_cast<std::int64_t>(run_.keyframes.size());
  if (run_.last_T_odom_base) selector_.keep(run_.keyframes.back().stamp, *run_.last_T_odom_base);
}

void StereoPass::process(PassItem& item) {
  const OdometryFrame& row = *item.odometry;
  const urban_nav_core::StereoPairWithMotion& frame = item.input.assembled;
  if (!row.accepted || frame.pair.left.empty() || frame.pair.right.empty()) return;
  if (!selector_.select(row.stamp, row.T_odom_base)) return;
  run_.last_T_odom_base = row.T_odom_base;
  const std::int64_t number = selected_++;
  if (auto output = matcher_.add(frame, number, number % run_.picture_step == 0)) put(std::move(*output));
}

std::string StereoPass::checkpoint() {
  writeAll();
  return packStereoRun(run_);
}

void StereoPass::put(StereoOutput output) {
  TableStore<urban_nav_store::GroundView>(store_).put(output.ground);
  if (output.points) TableStore<urban_nav_store::NearPoints>(store_).put(*output.points);
  if (output.view) TableStore<urban_nav_store::DepthView>(store_).put(*output.view);
  run_.keyframes.push_back(std::move(output.keyframe));
  if (output.picture) run_.pictures.push_back(std::move(*output.picture));
  const auto isBetween = [this](const StereoPicture& picture) { return picture.keyframe % run_.picture_step != 0; };
  if (run_.pictures.size() > kPicturedKeyframes) run_.picture_step *= 2;
  run_.pictures.erase(std::remove_if(run_.pictures.begin(), run_.pictures.end(), isBetween), run_.pictures.end());
}

void StereoPass::writeAll() {
  while (auto output = matcher_.next()) put(std::move(*output));
}

std::string StereoPass::packStereoRun(StereoRun& run) { return packState(kStereoRunName, kStereoRunVersion, run); }

StereoRun StereoPass::unpackStereoRun(std::string_view bytes) {
  StereoRun run;
  unpackState(kStereoRunName, kStereoRunVersion, bytes, run);
  return run;
}

}  // namespace urban_nav
