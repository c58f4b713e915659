// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/closure.hpp"

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Constraint;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;
using Message = urban_nav_msgs::MetricClosure;

namespace {

constexpr Eigen::Index kTangentSize = 6;

bool isProbability(double value) { return value >= 0.0 && value <= 1.0; }

std::uint8_t toMessage(ClosureMethod method) {
  switch (method) {
    case ClosureMethod::None: return Message::NONE;
    case ClosureMethod::Stereo: return Message::STEREO;
    case ClosureMethod::Icp: return Message::ICP;
  }
  return Message::NONE;
}

std::optional<ClosureMethod> toMethod(std::uint8_t value) {
  switch (value) {
    case Message::NONE: return ClosureMethod::None;
    case Message::STEREO: return ClosureMethod::Stereo;
    case Message::ICP: return ClosureMethod::Icp;
    default: return std::nullopt;
  }
}

std::optional<std::vector<Vector6d>> toDirections(const std::vector<double>& values) {
  std::vector<Vector6d> directions;
  const auto count = static_cast<Eigen::Index>(values.size());
  if (count % kTangentSize != 0) return std::nullopt;
  for (Eigen::Index at = 0; at < count; at += kTangentSize) {
    directions.emplace_back(Eigen::Map<const Vector6d>(values.data() + at));
    if (!directions.back().allFinite()) return std::nullopt;
  }
  return directions;
}

}  // namespace

urban_nav_msgs::PoseRef toPoseRefMessage(const urban_nav_core::PoseRef& ref) {
  urban_nav_msgs::PoseRef message;
  message.session = ref.session;
  message.stamp = toRosTime(ref.stamp);
  return message;
}

urban_nav_core::PoseRef toPoseRef(const urban_nav_msgs::PoseRef& message) {
  return {message.session, toStampNs(message.stamp)};
}

std::optional<Constraint> toConstraint(const geometry_msgs::Pose& T_a_b, const boost::array<double, 36>& information) {
  constexpr double kRounding = 1e-6;  // of numbers typed by hand or printed with six digits
  const auto pose = toPose(T_a_b);
  const Matrix6d matrix = toMatrix6(information);
  if (!pose || !matrix.allFinite()) return std::nullopt;
  const double largest = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > kRounding * largest) return std::nullopt;
  return Constraint{*pose, matrix};
}

urban_nav_msgs::TopologicalClosure toTopologicalClosureMessage(const urban_nav_core::TopologicalClosure& closure) {
  urban_nav_msgs::TopologicalClosure message;
  message.header.stamp = toRosTime(closure.b.stamp);
  message.a = toPoseRefMessage(closure.a);
  message.b = toPoseRefMessage(closure.b);
  message.probability = closure.probability;
  return message;
}

std::optional<urban_nav_core::TopologicalClosure> toTopologicalClosure(
    const urban_nav_msgs::TopologicalClosure& message) {
  if (!isProbability(message.probability)) return std::nullopt;
  return urban_nav_core::TopologicalClosure{toPoseRef(message.a), toPoseRef(message.b), message.probability};
}

urban_nav_msgs::MetricClosure toMetricClosureMessage(const urban_nav_core::MetricClosure& closure,
                                                     const std::string& child_frame, double length) {
  Message message;
  message.header.stamp = toRosTime(closure.b.stamp);
  message.header.frame_id = child_frame;
  message.a = toPoseRefMessage(closure.a);
  message.b = toPoseRefMessage(closure.b);
  message.T_a_b = toPoseMessage(closure.measured.T_a_b);
  message.information = toArray36(closure.measured.information);
  message.covariance = toArray36(urban_nav_core::covarianceForDisplay(closure.measured.information, length));
  for (const Vector6d& direction : closure.free_directions)
    message.free_directions.insert(message.free_directions.end(), direction.begin(), direction.end());
  message.method = toMessage(closure.method);
  message.odometry_gate = closure.odometry_gate;
  message.probability = closure.probability;
  message.evidence = closure.evidence;
  message.verdict = closure.verdict == ClosureVerdict::Accepted ? Message::ACCEPTED : Message::REJECTED;
  message.reason = closure.reason;
  message.reason_name = closure.reason_name;
  message.message = closure.sentence;
  message.source = closure.source;
  return message;
}

std::optional<urban_nav_core::MetricClosure> toMetricClosure(const Message& message) {
  const auto measured = toConstraint(message.T_a_b, message.information);
  const auto directions = toDirections(message.free_directions);
  const auto method = toMethod(message.method);
  const bool known_verdict = message.verdict == Message::ACCEPTED || message.verdict == Message::REJECTED;
  if (!measured || !directions || !method || !known_verdict || !isProbability(message.probability)) return std::nullopt;
  urban_nav_core::MetricClosure closure;
  closure.a = toPoseRef(message.a);
  closure.b = toPoseRef(message.b);
  closure.measured = *measured;
  closure.free_directions = *directions;
  closure.probability = message.probability;
  closure.method = *method;
  closure.odometry_gate = message.odometry_gate;
  closure.verdict = message.verdict == Message::ACCEPTED ? ClosureVerdict::Accepted : ClosureVerdict::Rejected;
  closure.reason = message.reason;
  closure.reason_name = message.reason_name;
  closure.sentence = message.message;
  closure.evidence = message.evidence;
  closure.source = message.source;
  return closure;
}

urban_nav_msgs::RelativeConstraint toRelativeConstraintMessage(const urban_nav_core::RelativeConstraint& constraint,
                                                               const std::string& child_frame) {
  urban_nav_msgs::RelativeConstraint message;
  message.header.stamp = toRosTime(constraint.b.stamp);
  message.header.frame_id = child_frame;
  message.a = toPoseRefMessage(constraint.a);
  message.b = toPoseRefMessage(constraint.b);
  message.T_a_b = toPoseMessage(constraint.measured.T_a_b);
  message.information = toArray36(constraint.measured.information);
  message.kind = constraint.kind;
  message.source = constraint.source;
  return message;
}

std::optional<urban_nav_core::RelativeConstraint> toRelativeConstraint(
    const urban_nav_msgs::RelativeConstraint& message) {
  const auto measured = toConstraint(message.T_a_b, message.information);
  if (!measured) return std::nullopt;
  return urban_nav_core::RelativeConstraint{toPoseRef(message.a), toPoseRef(message.b), *measured, message.kind,
                                            message.source};
}

}  // namespace urban_nav_ros
