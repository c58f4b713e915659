// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/new_college_log.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::atLine;
using urban_nav_core::expSo3;
using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::secondsBetween;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_core::Vector3d;

constexpr double kDegree = M_PI / 180.0;
constexpr StampNs kWindow = 2000000000;       // rows are at most 0.9 s late
constexpr StampNs kSameStamp = 100000;        // one of the stamps has only four decimals
constexpr double kLongestOff = 3600.0;        // s between the time of a value and of logging; more indicates damage
constexpr double kNeighbour = 0.2;            // s: headings further apart do not give the current turn rate
constexpr double kLadybugPeriod = 0.0133381;  // s per turn of the LMS, from a line fit through the stamps of the log
constexpr double kRangeMax = 80.0;            // m, reach of the LMS291

double computeYaw(const Pose& T) { return 2.0 * std::atan2(T.q().z(), T.q().w()); }

Quaterniond rollPitchYaw(double roll, double pitch, double yaw) {
  return expSo3({0.0, 0.0, yaw}) * expSo3({0.0, pitch, 0.0}) * expSo3({roll, 0.0, 0.0});
}

std::string baseName(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}

// theta = 0 is the +y axis of the log, counter-clockwise. The tilt is added from RAW, since that of this row is rotated
// by theta.
NewCollegeOdometry parseOdometry(const AlogFields& fields, StampNs stamp) {
  const auto pose = fields.array("Pose", 3);
  NewCollegeOdometry odometry;
  odometry.stamp = stamp;
  odometry.T_odom_base = Pose(expSo3({0.0, 0.0, pose[2] + M_PI / 2.0}), {pose[0], pose[1], 0.0});
  odometry.speed = fields.number("Speed");
  return odometry;
}

NewCollegePanorama parsePanorama(const AlogFields& fields, StampNs stamp, const std::string& where) {
  constexpr double kMostImages = 64.0;
  NewCollegePanorama panorama;
  panorama.stamp = stamp;
  const double count = fields.number("NumImages");
  if (count < 0.0 || count > kMostImages || std::floor(count) != count)
    throw UserError(where, "NumImages = " + std::to_string(count), "0...64");
  for (int i = 0; i < static_cast<int>(count); ++i)
    panorama.files.push_back(baseName(fields.text("File" + std::to_string(i))));
  return panorama;
}

}  // namespace

StampNs toStamp(const NewCollegeEvent& event) {
  return std::visit([](const auto& each) { return each.stamp; }, event);
}

NewCollegeLog::NewCollegeLog(const std::string& path) : path_(path), reader_(path) {}

std::optional<NewCollegeEvent> NewCollegeLog::next() {
  while (true) {
    const auto first = waiting_.begin();
    if (first != waiting_.end() && (ended_ || first->first <= *newest_ - kWindow)) return release(first);
    if (ended_) return std::nullopt;
    const auto row = reader_.next();
    if (row) take(*row);
    ended_ = !row;
  }
}

StampNs NewCollegeLog::computeTime(const AlogRow& row, const AlogFields& fields) const {
  const StampNs stamp = fields.stamp("time");
  const StampNs start = reader_.logStart().value_or(0);
  const double off = secondsBetween(start, stamp) - secondsBetween(0, row.logged);
  if (stamp < 0 || (reader_.logStart() && std::abs(off) > kLongestOff)) {
    throw UserError(atLine(path_, row.line), "time = " + std::string(fields.text("time")),
                    "Unix seconds within an hour of the logger's");
  }
  return stamp;
}

void NewCollegeLog::take(const AlogRow& row) {
  const std::string where = atLine(path_, row.line);
  if (row.variable == "LMS_LASER_2D_LEFT") return put(scan(row, Side::Left));
  if (row.variable == "LMS_LASER_2D_RIGHT") return put(scan(row, Side::Right));
  if (row.variable != "ODOMETRY_POSE" && row.variable != "RAW_ODOMETRY_POSE" && row.variable != "CAMERA_FILE_WRITE") {
    ++counts_.unused[std::string(row.variable)];
    return;
  }

  const AlogFields fields(row.value, where);
  const StampNs stamp = computeTime(row, fields);
  if (row.variable == "ODOMETRY_POSE") {
    put(parseOdometry(fields, stamp));
  } else if (row.variable == "CAMERA_FILE_WRITE") {
    put(parsePanorama(fields, stamp, where));
  } else {
    tilts_[stamp] = {fields.number("Pitch"), fields.number("Roll"), fields.number("PitchDot")};
    tilts_.erase(tilts_.begin(), tilts_.lower_bound(stamp - 2 * kWindow));
  }
}

NewCollegeScan NewCollegeLog::scan(const AlogRow& row, Side side) {
  const std::string where = atLine(path_, row.line);
  const AlogFields fields(row.value, where);
  const double step = fields.number("angRes"), first = fields.number("minAngle"), last = fields.number("maxAngle");
  const auto ranges = fields.array("Range");
  const auto reflectances = fields.array("Reflectance", ranges.size());
  const double beams = step > 0.0 ? (last - first) / step + 1.0 : 0.0;
  if (std::abs(beams - static_cast<double>(ranges.size())) > 1e-6) {
    throw UserError(where, std::to_string(ranges.size()) + " ranges",
                    "as many as given by minAngle, maxAngle and angRes");
  }
  NewCollegeScan out;
  out.stamp = computeTime(row, fields);
  out.side = side;
  out.id = static_cast<std::int64_t>(std::clamp(fields.number("ID"), -9e15, 9e15));
  out.scan.stamp = out.stamp;
  out.scan.angle_first = (first - 90.0) * kDegree;
  out.scan.angle_step = step * kDegree;
  out.scan.period = kLadybugPeriod;
  out.scan.time_step = kLadybugPeriod * step / 360.0;
  out.scan.range_max = kRangeMax;
  // Values below zero are error codes of the device.
  for (const double range : ranges) out.scan.ranges.push_back(range > 0.0 ? static_cast<float>(range) : 0.0F);
  for (const double reflectance : reflectances) out.scan.intensities.push_back(static_cast<float>(reflectance));
  return out;
}

void NewCollegeLog::put(NewCollegeEvent event) {
  const StampNs stamp = toStamp(event);
  if (released_ && stamp < *released_) {
    ++counts_.out_of_order;
    return;
  }
  newest_ = std::max(newest_.value_or(stamp), stamp);
  waiting_.emplace(stamp, std::move(event));
}

NewCollegeEvent NewCollegeLog::release(Waiting::iterator at) {
  NewCollegeEvent event = std::move(at->second);
  released_ = at->first;
  waiting_.erase(at);
  if (auto* odometry = std::get_if<NewCollegeOdometry>(&event)) {
    complete(*odometry);
    ++counts_.odometry;
  } else if (const auto* scan = std::get_if<NewCollegeScan>(&event)) {
    ++(scan->side == Side::Left ? counts_.scans_left : counts_.scans_right);
    const auto last = last_id_.find(scan->side);
    if (last != last_id_.end() && scan->id > last->second + 1) counts_.scans_lost += scan->id - last->second - 1;
    last_id_[scan->side] = scan->id;
  } else {
    ++counts_.panoramas;
  }
  return event;
}

void NewCollegeLog::complete(NewCollegeOdometry& odometry) {
  odometry.yaw_rate = yawRate(odometry);
  last_odometry_ = odometry;
  auto tilt = tilts_.lower_bound(odometry.stamp - kSameStamp);
  if (tilt == tilts_.end() || tilt->first > odometry.stamp + kSameStamp) {
    ++counts_.odometry_without_tilt;
    return;
  }
  // In RAW, pitch is about the axis to the right, and roll is positive with the left side up.
  const double yaw = computeYaw(odometry.T_odom_base);
  odometry.T_odom_base = Pose(rollPitchYaw(tilt->second.roll, -tilt->second.pitch, yaw), odometry.T_odom_base.t());
  odometry.pitch_rate = -tilt->second.pitch_rate;
}

// Central difference of the headings, without lag; one-sided at the ends and at gaps.
double NewCollegeLog::yawRate(const NewCollegeOdometry& odometry) const {
  const NewCollegeOdometry* before =
      last_odometry_ && secondsBetween(last_odometry_->stamp, odometry.stamp) <= kNeighbour ? &*last_odometry_
                                                                                            : &odometry;
  const NewCollegeOdometry* after = &odometry;
  for (const auto& [stamp, event] : waiting_) {
    const auto* next = std::get_if<NewCollegeOdometry>(&event);
    if (next == nullptr) continue;
    if (secondsBetween(odometry.stamp, stamp) <= kNeighbour) after = next;
    break;
  }
  const double seconds = secondsBetween(before->stamp, after->stamp);
  if (!(seconds > 0.0)) return 0.0;
  return std::remainder(computeYaw(after->T_odom_base) - computeYaw(before->T_odom_base), 2.0 * M_PI) / seconds;
}

}  // namespace urban_nav_input
