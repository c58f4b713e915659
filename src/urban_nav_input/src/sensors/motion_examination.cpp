// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/motion_examination.hpp"

#include <algorithm>
#include <cmath>

#include "sensors/interpolation.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_input/sensors/turn_delay.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::StampNs;

namespace {

constexpr double kLeastDistance = 0.03, kLeastTurn = 0.02;  // m, rad: smallest motion of a used interval
constexpr double kSmallTurn =
    0.005;                      // rad: 12 times the rotation error from 25 features with 1 px of noise at f = 500 px
constexpr double kGross = 3.0;  // larger ratios are also significant for small rotations
constexpr std::size_t kLeastIntervals = 5;
constexpr double kMostSpread = 0.35;                // relative spread of the quartiles for a consistent scale
constexpr double kScaleTolerance = 0.2;             // relative, for slip and worn tyres
constexpr StampNs kTurnWindow = 2'000'000'000;      // ns, of intervals that compare wheels and gyroscope
constexpr double kDegreesPerRadian = 180.0 / M_PI;  // rates in deg/s over rates in rad/s
constexpr double kFewMetres = 2.0;                  // m: distance by speeds while poses do not move
constexpr std::size_t kMostPoses = 2'000'000;
constexpr double kSameDelay = 0.02;  // s: difference of two sensors with one clock

double wrap(double angle) { return std::remainder(angle, 2.0 * M_PI); }

/// Ratio of two sensors.
struct Ratio {
  double value = 0.0;
  std::size_t intervals = 0;
};

/// Returns the median ratio of measured to reference motion over intervals with sufficient reference motion; nullopt if
/// they are few or inconsistent.
std::optional<Ratio> findRatio(const std::vector<std::pair<double, double>>& measured_reference, double least) {
  std::vector<double> ratios;
  for (const auto& [measured, reference] : measured_reference)
    if (std::abs(reference) >= least) ratios.push_back(measured / reference);
  if (ratios.size() < kLeastIntervals) return std::nullopt;
  const double median = urban_nav_core::quantile(ratios, 0.5);
  const double spread = urban_nav_core::quantile(ratios, 0.75) - urban_nav_core::quantile(ratios, 0.25);
  if (spread > kMostSpread * std::abs(median)) return std::nullopt;
  return Ratio{median, ratios.size()};
}

/// Returns the ratio of rotations, using small ones too if it is far above one, as for rates in deg/s. A ratio far
/// below one may be due to a frozen reading.
std::optional<Ratio> findTurnRatio(const std::vector<std::pair<double, double>>& measured_reference, double least) {
  if (const auto ratio = findRatio(measured_reference, least)) return ratio;
  const auto ratio = findRatio(measured_reference, kSmallTurn / kLeastTurn * least);
  return ratio && std::abs(ratio->value) > kGross ? ratio : std::nullopt;
}

bool isOne(double ratio) { return std::abs(ratio - 1.0) <= kScaleTolerance; }

/// Returns the common unit factor near a ratio, or the ratio rounded to three digits.
double nameable(double ratio) {
  for (const double usual : {1000.0, 100.0, kDegreesPerRadian, 1.0 / kDegreesPerRadian, 0.01, 0.001, -1.0})
    if (std::abs(ratio / usual - 1.0) <= kScaleTolerance) return usual;
  const double digit = std::pow(10.0, std::floor(std::log10(std::abs(ratio))) - 2.0);
  return std::round(ratio / digit) * digit;
}

/// Returns the likely cause of a ratio of distances.
std::string distanceCause(double ratio) {
  const double named = nameable(ratio);
  if (named == -1.0) return "the direction of travel has the wrong sign";
  if (named == 1000.0) return "positions are in millimetres";
  if (named == 100.0) return "positions are in centimetres";
  return std::string("the scale of the encoders, or the baseline of the stereo camera, is wrong") +
         (ratio < 0.0 ? ", and the direction of travel has the wrong sign" : "");
}

Finding scaleFinding(FindingKind kind, const std::string& text, const std::string& parameter, double scale,
                     const std::string& later) {
  Finding finding{kind, text, "", false, {"--set", "input." + parameter + "=" + urban_nav_core::printNumber(scale)}};
  finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings " + later;
  return finding;
}

/// Returns a scale rounded to four digits.
double rounded(double scale) {
  const double digit = std::pow(10.0, std::floor(std::log10(std::abs(scale))) - 3.0);
  return std::round(scale / digit) * digit;
}

}  // namespace

void MotionExamination::addWheels(StampNs stamp, const std::array<double, 3>& x_y_yaw, double speed) {
  for (const double number : x_y_yaw)
    if (!std::isfinite(number) || std::abs(number) > 1e9) return;
  if (stamp <= 0 || wheels_.size() >= kMostPoses || (!wheel_stamps_.empty() && stamp <= wheel_stamps_.back())) return;
  std::array<double, 2> now = {{0.0, 0.0}};
  if (!wheels_.empty()) {
    const double dx = x_y_yaw[0] - last_pose_[0], dy = x_y_yaw[1] - last_pose_[1];
    const double turn = wrap(x_y_yaw[2] - last_pose_[2]), heading = last_pose_[2] + 0.5 * turn;
    now = {{wheels_.back()[0] + std::cos(heading) * dx + std::sin(heading) * dy, wheels_.back()[1] + turn}};
  }
  last_pose_ = x_y_yaw;
  wheel_stamps_.push_back(stamp);
  wheels_.push_back(now);
  if (!std::isfinite(speed)) return;
  if (speed_stamp_ > 0 && stamp - speed_stamp_ < kLongestInterpolatedGap)
    by_speed_ += std::abs(0.5 * (speed + speed_)) * 1e-9 * static_cast<double>(stamp - speed_stamp_);
  speed_ = speed;
  speed_stamp_ = stamp;
}

void MotionExamination::addGyroscope(StampNs stamp, double yaw_rate) {
  if (!std::isfinite(yaw_rate) || std::abs(yaw_rate) > 1e6 || stamp <= 0 || gyroscope_.size() >= kMostPoses) return;
  if (!gyroscope_stamps_.empty() && stamp <= gyroscope_stamps_.back()) return;
  double heading = 0.0;
  if (!gyroscope_.empty()) {
    const double seconds = 1e-9 * static_cast<double>(stamp - gyroscope_stamps_.back());
    heading = gyroscope_.back() + 0.5 * (last_rate_ + yaw_rate) * seconds;
  }
  last_rate_ = yaw_rate;
  gyroscope_stamps_.push_back(stamp);
  gyroscope_.push_back(heading);
}

MotionExamination::Ratios MotionExamination::compare(const std::vector<SeenMotion>& seen) const {
  const auto distance = [this](std::size_t i) { return wheels_[i][0]; };
  const auto heading = [this](std::size_t i) { return wheels_[i][1]; };
  const auto by_gyroscope = [this](std::size_t i) { return gyroscope_[i]; };
  const auto add = [](const auto& stamps, const auto& value_of, StampNs from, StampNs to, double reference,
                      Pairs& pairs) {
    const auto begin = interpolate(stamps, value_of, from), end = interpolate(stamps, value_of, to);
    if (begin && end) pairs.emplace_back(*end - *begin, reference);
  };
  Ratios ratios;
  for (const SeenMotion& motion : seen) {
    const auto R = motion.T_from_to.R();
    const double yaw = std::atan2(R(1, 0), R(0, 0));
    add(wheel_stamps_, distance, motion.from, motion.to, motion.T_from_to.t().x(), ratios.distances);
    add(wheel_stamps_, heading, motion.from, motion.to, yaw, ratios.wheel_turns);
    add(gyroscope_stamps_, by_gyroscope, motion.from, motion.to, yaw, ratios.gyroscope_turns);
  }
  if (gyroscope_stamps_.empty()) return ratios;
  for (StampNs from = gyroscope_stamps_.front(); from + kTurnWindow <= gyroscope_stamps_.back(); from += kTurnWindow) {
    const StampNs to = from + kTurnWindow;
    const auto begin = interpolate(wheel_stamps_, heading, from), end = interpolate(wheel_stamps_, heading, to);
    if (begin && end) add(gyroscope_stamps_, by_gyroscope, from, to, *end - *begin, ratios.gyroscope_wheels);
  }
  return ratios;
}

std::optional<Finding> MotionExamination::distanceFinding(const Ratios& ratios, const std::string& wheels,
                                                          const urban_nav_ros::SensorCorrections& present) const {
  const auto ratio = findRatio(ratios.distances, kLeastDistance);
  if (ratio && ratio->value != 0.0 && !isOne(ratio->value))
    return scaleFinding(FindingKind::Wheels,
                        wheels + ": its distances are " + formatNumber(ratio->value, 3) +
                            " times those measured by stereo (" + std::to_string(ratio->intervals) +
                            " intervals): " + distanceCause(ratio->value),
                        "wheels_scale", rounded(present.wheels_scale / nameable(ratio->value)),
                        "let the driver of the wheels publish metres, forward positive");
  if (wheels_.empty() || by_speed_ <= kFewMetres) return std::nullopt;
  const auto [least, most] = std::minmax_element(wheels_.begin(), wheels_.end());
  if ((*most)[0] - (*least)[0] >= 0.01 * by_speed_) return std::nullopt;
  return Finding{FindingKind::Wheels,
                 wheels + ": its twist integrates to a distance of " + formatNumber(by_speed_, 3) +
                     " m, but its pose does not move: wheel odometry is not integrated and cannot be used",
                 "let the driver of the wheels publish a pose and the twist"};
}

std::optional<Finding> MotionExamination::turnFinding(const Ratios& ratios, bool are_wheels_sound,
                                                      const std::string& imu,
                                                      const urban_nav_ros::SensorCorrections& present) {
  auto turn = findTurnRatio(ratios.gyroscope_turns, kLeastTurn);
  const bool by_stereo = turn.has_value();
  if (!turn && are_wheels_sound) turn = findTurnRatio(ratios.gyroscope_wheels, 5.0 * kLeastTurn);
  if (!turn || turn->value == 0.0 || isOne(turn->value)) return std::nullopt;
  const double named = nameable(turn->value);
  const std::string text = imu + ": its rotations are " + formatNumber(turn->value, 3) + " times those measured by " +
                           (by_stereo ? "stereo" : "the wheels") + " (" + std::to_string(turn->intervals) +
                           " intervals): ";
  if (named > 0.0)
    return scaleFinding(FindingKind::Imu,
                        text + (named == kDegreesPerRadian ? "rates are in deg/s" : "the scale of rates is wrong"),
                        "gyroscope_scale", present.gyroscope_scale / named, "let the driver of the IMU publish rad/s");
  return Finding{FindingKind::Imu,
                 text + "axes of the gyroscope have the wrong sign, as between NED and the axes of ROS",
                 "--transform PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW sets the axes of the device; for later "
                 "recordings let the driver publish axes of ROS (REP-103)"};
}

std::optional<Finding> MotionExamination::delayFinding(const std::vector<SeenMotion>& seen, const std::string& wheels,
                                                       const std::string& imu,
                                                       const urban_nav_ros::SensorCorrections& present) const {
  std::vector<double> by_wheels;
  for (const std::array<double, 2>& travelled : wheels_) by_wheels.push_back(travelled[1]);
  const std::optional<double> imu_delay = findTurnDelay(gyroscope_stamps_, gyroscope_, seen),
                              wheels_delay = findTurnDelay(wheel_stamps_, by_wheels, seen);
  if (!imu_delay && !wheels_delay) return std::nullopt;
  const bool both = imu_delay && wheels_delay && std::abs(*imu_delay - *wheels_delay) < kSameDelay;
  const double delay = imu_delay ? *imu_delay : *wheels_delay;
  const std::string late = formatNumber(std::abs(delay), 3) + " s ", by = " than those of ";
  Finding finding{FindingKind::Stamps, "", "synchronise the clocks (chrony, PTP) while recording"};
  if (both)
    finding.text = "the stamps of the images are " + late + (delay < 0.0 ? "later" : "earlier") + by + imu + " and " +
                   wheels + ", by the turns that all measure: images are stamped on receipt, or their clock is wrong";
  else
    finding.text = (imu_delay ? imu : wheels) + ": its stamps are " + late + (delay < 0.0 ? "earlier" : "later") + by +
                   "the images, by the turns that both measure: the clock of its computer or device is wrong";
  const auto set = [&](const char* name, double now) {
    finding.options.emplace_back("--set");
    finding.options.push_back("input." + std::string(name) + "=" +
                              urban_nav_core::printNumber(std::round(1e3 * (1e-9 * now + delay))));
  };
  if (imu_delay) set("imu_delay", static_cast<double>(present.imu_delay));
  if (both || !imu_delay) set("wheels_delay", static_cast<double>(present.wheels_delay));
  std::string options;
  for (const std::string& option : finding.options) options += (options.empty() ? "" : " ") + option;
  finding.remedy = options + (both ? ", and the same for lasers and GPS if they share this clock" : "") +
                   "; for later recordings, " + finding.remedy;
  return finding;
}

std::vector<Finding> MotionExamination::findings(const std::vector<SeenMotion>& seen, const std::string& wheels,
                                                 const std::string& imu,
                                                 const urban_nav_ros::SensorCorrections& present) const {
  const Ratios ratios = compare(seen);
  std::vector<Finding> findings;
  if (auto finding = distanceFinding(ratios, wheels, present)) findings.push_back(std::move(*finding));
  const auto turn = findRatio(ratios.wheel_turns, kLeastTurn);
  const bool are_turns_sound = !turn || turn->value >= 0.0;
  if (!are_turns_sound)
    findings.push_back({FindingKind::Wheels,
                        wheels + ": its rotations are " + formatNumber(turn->value, 3) +
                            " times those measured by stereo: left and right wheel are exchanged, or rotations are "
                            "positive clockwise",
                        "let the driver of the wheels publish rotations to the left as positive (REP-103)"});
  if (auto finding = turnFinding(ratios, are_turns_sound, imu, present)) findings.push_back(std::move(*finding));
  if (auto finding = delayFinding(seen, wheels, imu, present)) findings.push_back(std::move(*finding));
  return findings;
}

}  // namespace urban_nav_input
