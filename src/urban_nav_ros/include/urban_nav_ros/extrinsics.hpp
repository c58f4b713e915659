// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_ros {

/// Static transforms from /tf_static, a robot description or a bag: a forest of frames. The later of two transforms to
/// the same child is used, unless the earlier one was set by the user; both are reported in faults() if they differ.
/// Leading slashes of names are removed (tf of 2008 has them).
class StaticTransforms {
 public:
  /// Adds transforms. Transforms that are not rigid motions are ignored and reported in faults(). Quaternions whose
  /// length differs from 1 are normalised and reported, or ignored if the length is too far from 1.
  void add(const tf2_msgs::TFMessage& message);
  void add(const geometry_msgs::TransformStamped& transform);

  /// Notes a transform that changes over time; lookup() does not use it.
  void addMoving(const std::string& parent, const std::string& child);
  /// Returns the first frame from `from` up to its ancestor `to` whose transform changes over time; empty if there is
  /// none, or if `to` is no ancestor.
  std::string findMoving(const std::string& to, const std::string& from) const;

  /// Sets a transform by the user, which takes precedence over all others to its child.
  void give(const geometry_msgs::TransformStamped& transform);

  /// Returns T_to_from, which takes coordinates in `from` to coordinates in `to`; empty if the tree does not connect
  /// them. A frame is connected to itself.
  std::optional<urban_nav_core::Pose> lookup(const std::string& to, const std::string& from) const;
  bool has(const std::string& frame) const;
  /// Returns whether a transform to this child is known.
  bool hasParent(const std::string& child) const;
  bool empty() const { return parents_.empty(); }
  std::vector<std::string> frames() const;
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  struct Link {
    std::string parent;
    urban_nav_core::Pose T_parent_child;
    bool is_given = false;
  };
  void addFault(const std::string& fault);
  struct Climb {
    std::string root;
    urban_nav_core::Pose T_root_frame;
  };
  std::optional<Climb> climb(const std::string& frame) const;

  std::map<std::string, Link> parents_;        // by child
  std::map<std::string, std::string> moving_;  // parents by child
  std::vector<std::string> faults_;
};

/// Returns a sensor's mounting as a message for /tf_static. Its stamp is zero: static transforms are always valid.
geometry_msgs::TransformStamped toStaticTransform(const std::string& parent, const std::string& child,
                                                  const urban_nav_core::Pose& T_parent_child);

/// Returns the axes of an optical frame (z forward, x right, y down) in a body frame (x forward, y left, z up),
/// REP-103.
urban_nav_core::Pose opticalInBody();

}  // namespace urban_nav_ros
