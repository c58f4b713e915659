// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/inertial/accelerometer_check.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "urban_nav_core/inertial/axis_map.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_core {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kGravity = 9.80665;                  // m/s2
constexpr double kLeastSize = 9.0, kMostSize = 11.0;  // m/s2: vibration increases the mean length
constexpr double kNoGravity = 3.0;                    // m/s2: no drive has such a mean acceleration
constexpr double kSteady = 0.8;                       // least ratio of the length of the mean to the mean length
constexpr double kTilted = 45.0;                      // deg: more than any road slope or mounting error
constexpr double kFits = 30.0;                        // deg
constexpr double kUnitTolerance = 0.08;               // relative
constexpr double kCorrelated = 0.3;                   // least correlation of lateral force with yaw rate
constexpr double kSameCorrelation = 0.1;              // candidates within this difference are equivalent
constexpr double kMostForce = 1e6, kMostRate = 1e6;   // m/s2, rad/s: larger values are invalid
constexpr double kMostWeight = 60'000.0;              // measurements: ten minutes at 100 Hz
constexpr double kDegrees = 180.0 / 3.14159265358979323846;

struct Unit {
  double size;  // m/s2
  const char* name;
};
constexpr std::array<Unit, 4> kUnits = {
    {{kGravity, "g"}, {1e-3 * kGravity, "thousandths of g"}, {0.01, "cm/s2"}, {0.001, "mm/s2"}}};

const Unit* findUnit(double size) {
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(), [size](const Unit& each) {
    return std::abs(size * each.size / kGravity - 1.0) < kUnitTolerance;
  });
  return unit == kUnits.end() ? nullptr : &*unit;
}

double angleBetween(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Returns a rank of conventions, larger for less common ones.
double oddness(const Matrix3d& axes) {
  const double negative = static_cast<double>((axes.array() < 0.0).count());
  const bool moved = (axes.diagonal().array() == 0.0).any();
  const bool is_mirrored = axes.col(0).cross(axes.col(1)).dot(axes.col(2)) < 0.0;
  if (negative == 3.0 && !moved) return 1.0;  // gravity instead of specific force
  return negative + (moved ? 1.5 : 0.0) + (is_mirrored ? 0.75 : 0.0);
}

std::string printForce(const Vector3d& force) {
  std::string text = "(";
  for (int i = 0; i < 3; ++i) text += (i > 0 ? ", " : "") + formatNumber(force(i), 3);
  return text + ")";
}

std::string describeCause(const Matrix3d& axes) {
  const bool moved = (axes.diagonal().array() == 0.0).any();
  if (!moved && (axes.diagonal().array() < 0.0).all())
    return "the messages contain gravity instead of specific force (sign of NED)";
  if (!moved) return "axes of the messages have the wrong sign, as between NED and the axes of ROS";
  return "axes of the messages are exchanged";
}

}  // namespace

const char* toString(AccelerometerFault fault) {
  switch (fault) {
    case AccelerometerFault::None: return "None";
    case AccelerometerFault::NotFinite: return "NotFinite";
    case AccelerometerFault::NoGravity: return "NoGravity";
    case AccelerometerFault::Unit: return "Unit";
    case AccelerometerFault::Size: return "Size";
    case AccelerometerFault::Direction: return "Direction";
  }
  return "";
}

std::string AccelerometerVerdict::sentence() const {
  const std::string start = "the accelerometer measures ";
  const std::string length = formatNumber(size, 4) + " m/s2 on average instead of 9.81";
  switch (fault) {
    case AccelerometerFault::None: return "";
    case AccelerometerFault::NotFinite: return start + "no finite value";
    case AccelerometerFault::NoGravity: return start + length + ": the device or its driver subtracts gravity";
    case AccelerometerFault::Unit: {
      const Unit* unit = findUnit(size);
      return start + length + ": its unit is " + (unit == nullptr ? "another" : unit->name);
    }
    case AccelerometerFault::Size: return start + length + ": wrong scale";
    case AccelerometerFault::Direction:
      return start + "a mean specific force of " + printForce(mean) + " m/s2 in the axes of its device, " +
             formatNumber(kDegrees * angle, 4) + " deg from vertical in base_link: " +
             (repair ? describeCause(repair->axes) : "its pose in tf or its axes are wrong");
  }
  return "";
}

void AccelerometerCheck::add(const Vector3d& force, const Vector3d& rate) {
  ++count_;
  if (!force.allFinite() || force.norm() > kMostForce) return;
  ++finite_;
  if (weight_ > kMostWeight) {
    for (double* sum : {&weight_, &length_, &rate_weight_}) *sum *= 0.5;
    for (Vector3d* sum : {&force_, &rate_}) *sum *= 0.5;
    for (Matrix3d* sum : {&force_rate_, &force_force_, &rate_rate_}) *sum *= 0.5;
  }
  weight_ += 1.0;
  length_ += force.norm();
  force_ += force;
  force_force_ += force * force.transpose();
  if (!rate.allFinite() || rate.norm() > kMostRate) return;
  rate_weight_ += 1.0;
  rate_ += rate;
  force_rate_ += force * rate.transpose();
  rate_rate_ += rate * rate.transpose();
}

AccelerometerFault AccelerometerCheck::findFault(const Vector3d& up) const {
  if (count_ == 0) return AccelerometerFault::None;
  if (weight_ == 0.0) return AccelerometerFault::NotFinite;
  const double size = length_ / weight_;
  if (findUnit(size) != nullptr) return AccelerometerFault::Unit;
  if (size < kNoGravity) return AccelerometerFault::NoGravity;
  if (size < kLeastSize || size > kMostSize) return AccelerometerFault::Size;
  if (force_.norm() < kSteady * length_) return AccelerometerFault::None;
  return kDegrees * angleBetween(force_, up) > kTilted ? AccelerometerFault::Direction : AccelerometerFault::None;
}

bool AccelerometerCheck::isPlausible(const Vector3d& up) const { return findFault(up) == AccelerometerFault::None; }

AccelerometerConvention AccelerometerCheck::bestAxes(const Vector3d& up, const Vector3d& left) const {
  struct Candidate {
    Matrix3d axes;
    double correlation;
  };
  const double n = std::max(1.0, rate_weight_);
  const Vector3d mean = force_ / weight_;
  const Matrix3d spread = force_force_ / weight_ - mean * mean.transpose();
  const Matrix3d with_rate = force_rate_ / n - mean * (rate_ / n).transpose();
  const double rate_variance = up.dot((rate_rate_ / n - rate_ / n * (rate_ / n).transpose()) * up);
  std::vector<Candidate> candidates;
  double best = kCorrelated;
  for (const Matrix3d& axes : allAxisMaps()) {
    if (kDegrees * angleBetween(axes * force_, up) > kFits) continue;
    const Vector3d lateral = axes.transpose() * left;  // in the measured axes
    const double variance = lateral.dot(spread * lateral) * rate_variance;
    const double correlation = variance > 0.0 ? lateral.dot(with_rate * up) / std::sqrt(variance) : 0.0;
    candidates.push_back({axes, correlation});
    best = std::max(best, correlation);
  }
  if (std::none_of(candidates.begin(), candidates.end(),
                   [](const Candidate& each) { return each.correlation >= kCorrelated; }))
    best = -1.0;  // not significant
  AccelerometerConvention convention;
  double least = 1e9;
  for (const Candidate& each : candidates) {
    if (each.correlation < best - kSameCorrelation || oddness(each.axes) >= least) continue;
    least = oddness(each.axes);
    convention.axes = each.axes;
  }
  return convention;
}

AccelerometerVerdict AccelerometerCheck::verdict(const Vector3d& up, const Vector3d& left) const {
  AccelerometerVerdict verdict;
  verdict.fault = findFault(up);
  if (weight_ == 0.0) return verdict;
  verdict.size = length_ / weight_;
  verdict.mean = force_ / weight_;
  verdict.angle = angleBetween(force_, up);
  if (verdict.fault == AccelerometerFault::Unit) verdict.repair.emplace().scale = findUnit(verdict.size)->size;
  const bool is_turned = kDegrees * verdict.angle > kTilted && force_.norm() > kSteady * length_;
  if (!is_turned || (verdict.fault != AccelerometerFault::Direction && !verdict.repair)) return verdict;
  const AccelerometerConvention turned = bestAxes(up, left);
  if (turned.axes == Matrix3d::Identity()) return verdict;  // no convention fits
  if (!verdict.repair) verdict.repair.emplace();
  verdict.repair->axes = turned.axes;
  return verdict;
}

}  // namespace urban_nav_core
