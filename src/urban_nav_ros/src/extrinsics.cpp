// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/extrinsics.hpp"

#include <algorithm>
#include <set>

#include "urban_nav_ros/pose.hpp"

namespace urban_nav_ros {

using urban_nav_core::Pose;

namespace {
std::string bare(const std::string& frame) { return frame.empty() || frame.front() != '/' ? frame : frame.substr(1); }
}  // namespace

void StaticTransforms::add(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) add(transform);
}

void StaticTransforms::add(const geometry_msgs::TransformStamped& transform) {
  const std::string parent = bare(transform.header.frame_id);
  const std::string child = bare(transform.child_frame_id);
  const std::optional<Pose> pose = toPose(transform.transform);
  if (parent.empty() || child.empty() || parent == child || !pose) {
    faults_.push_back("static transform from \"" + parent + "\" to \"" + child +
                      "\" is no rigid motion between two frames");
    return;
  }
  parents_[child] = {parent, *pose};
}

std::optional<StaticTransforms::Climb> StaticTransforms::climb(const std::string& frame) const {
  Climb result{bare(frame), Pose()};
  for (std::size_t steps = 0; steps <= parents_.size(); ++steps) {
    const auto link = parents_.find(result.root);
    if (link == parents_.end()) return result;
    result = {link->second.parent, link->second.T_parent_child * result.T_root_frame};
  }
  return std::nullopt;  // a ring
}

std::optional<Pose> StaticTransforms::lookup(const std::string& to, const std::string& from) const {
  const std::optional<Climb> up_to = climb(to);
  const std::optional<Climb> up_from = climb(from);
  if (!up_to || !up_from || up_to->root != up_from->root) return std::nullopt;
  return up_to->T_root_frame.inverse() * up_from->T_root_frame;
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
