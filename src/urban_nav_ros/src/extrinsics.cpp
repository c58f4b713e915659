// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/extrinsics.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_ros/pose.hpp"

namespace urban_nav_ros {

using urban_nav_core::Pose;

namespace {

constexpr double kUnit = 1e-3;                     // tolerance of a quaternion's length
constexpr double kShortest = 0.5, kLongest = 2.0;  // range of lengths that are normalised
constexpr double kSameDistance = 1e-3;             // m
constexpr double kSameAngle = 0.1 * M_PI / 180.0;  // rad

std::string bare(const std::string& frame) { return frame.empty() || frame.front() != '/' ? frame : frame.substr(1); }
}  // namespace

void StaticTransforms::add(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) add(transform);
}

void StaticTransforms::add(const geometry_msgs::TransformStamped& transform) {
  const std::string parent = bare(transform.header.frame_id);
  const std::string child = bare(transform.child_frame_id);
  const auto& q = transform.transform.rotation;
  const double length = urban_nav_core::Quaterniond(q.w, q.x, q.y, q.z).norm();
  geometry_msgs::Transform unit = transform.transform;
  if (length > kShortest && length < kLongest) {
    unit.rotation.x /= length, unit.rotation.y /= length, unit.rotation.z /= length, unit.rotation.w /= length;
    if (std::abs(length - 1.0) > kUnit)
      addFault("static transform from \"" + parent + "\" to \"" + child + "\" has a quaternion of length " +
               urban_nav_core::formatNumber(length, 4) + ", no unit quaternion; it is normalised");
  }
  const std::optional<Pose> pose = toPose(unit);
  if (parent.empty() || child.empty() || parent == child || !pose) {
    addFault("static transform from \"" + parent + "\" to \"" + child + "\" is no rigid motion between two frames");
    return;
  }
  const auto known = parents_.find(child);
  if (known != parents_.end()) {
    const double apart = (known->second.T_parent_child.t() - pose->t()).norm();
    const double angle = known->second.T_parent_child.q().angularDistance(pose->q());
    if (known->second.is_given) return;
    if (known->second.parent != parent)
      addFault("two static transforms to \"" + child + "\" contradict each other: one from \"" + known->second.parent +
               "\", a later one from \"" + parent + "\"; the later one is used");
    else if (apart > kSameDistance || angle > kSameAngle)
      addFault("two static transforms from \"" + parent + "\" to \"" + child +
               "\" contradict each other: they differ by " + urban_nav_core::formatNumber(apart, 3) + " m and " +
               urban_nav_core::formatNumber(angle * 180.0 / M_PI, 3) + " deg; the later one is used");
  }
  parents_[child] = {parent, *pose};
}

void StaticTransforms::give(const geometry_msgs::TransformStamped& transform) {
  const std::string child = bare(transform.child_frame_id);
  parents_.erase(child);
  add(transform);
  if (const auto link = parents_.find(child); link != parents_.end()) link->second.is_given = true;
}

void StaticTransforms::addFault(const std::string& fault) {
  if (std::find(faults_.begin(), faults_.end(), fault) == faults_.end()) faults_.push_back(fault);
}

std::optional<StaticTransforms::Climb> StaticTransforms::climb(const std::string& frame) const {
  Climb result{bare(frame), Pose()};
  for (std::size_t steps = 0; steps <= parents_.size(); ++steps) {
    const auto link = parents_.find(result.root);
    if (link == parents_.end()) return result;
    result = {link->second.parent, link->second.T_parent_child * result.T_root_frame};
  }
  return std::nullopt;  // cycle of frames
}

std::optional<Pose> StaticTransforms::lookup(const std::string& to, const std::string& from) const {
  const std::optional<Climb> up_to = climb(to);
  const std::optional<Climb> up_from = climb(from);
  if (!up_to || !up_from || up_to->root != up_from->root) return std::nullopt;
  return up_to->T_root_frame.inverse() * up_from->T_root_frame;
}

void StaticTransforms::addMoving(const std::string& parent, const std::string& child) {
  moving_[bare(child)] = bare(parent);
}

std::string StaticTransforms::findMoving(const std::string& to, const std::string& from) const {
  std::string frame = bare(from), moving;
  for (std::size_t steps = 0; steps <= parents_.size() + moving_.size(); ++steps) {
    if (frame == bare(to)) return moving;
    const auto link = parents_.find(frame);
    const auto moved = moving_.find(frame);
    if (link == parents_.end() && moved == moving_.end()) return "";
    if (link == parents_.end() && moving.empty()) moving = frame;
    frame = link == parents_.end() ? moved->second : link->second.parent;
  }
  return "";  // cycle of frames
}

bool StaticTransforms::hasParent(const std::string& child) const { return parents_.count(bare(child)) > 0; }

bool StaticTransforms::has(const std::string& frame) const {
  const std::vector<std::string> all = frames();
  return std::find(all.begin(), all.end(), bare(frame)) != all.end();
}

std::vector<std::string> StaticTransforms::frames() const {
  std::set<std::string> names;
  for (const auto& [child, link] : parents_) {
    names.insert(child);
    names.insert(link.parent);
  }
  return {names.begin(), names.end()};
}

geometry_msgs::TransformStamped toStaticTransform(const std::string& parent, const std::string& child,
                                                  const Pose& T_parent_child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform = toTransformMessage(T_parent_child);
  return transform;
}

Pose opticalInBody() {
  return Pose(urban_nav_core::Quaterniond(0.5, -0.5, 0.5, -0.5), urban_nav_core::Vector3d::Zero());
}

}  // namespace urban_nav_ros
