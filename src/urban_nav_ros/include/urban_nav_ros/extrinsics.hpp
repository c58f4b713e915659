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

/// Static transforms as they come on /tf_static, from the robot description or a bag: a forest of frames. The later of
/// two transforms to the same child wins, unless the first was given by the user, and both are named in faults() if
/// they differ. Names are taken without a leading slash (tf's of 2008 have one).
class StaticTransforms {
 public:
  /// Transforms that are no rigid motion are left out and named in faults(). Quaternions of another length than 1 are
  /// normalised and named, unless their length is too far from 1 for a rotation.
  void add(const tf2_msgs::TFMessage& message);
  void add(const geometry_msgs::TransformStamped& transform);

  /// Adds a transform that takes precedence over all others to its child.
  void give(const geometry_msgs::TransformStamped& transform);

  /// T_to_from: takes coordinates in `from` to coordinates in `to`. Empty where the tree does not connect them. A frame
  /// is connected to itself.
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

  std::map<std::string, Link> parents_;  // by child
  std::vector<std::string> faults_;
};

/// A transform of a sensor's place for /tf_static; its stamp stays zero, static transforms hold always.
geometry_msgs::TransformStamped toStaticTransform(const std::string& parent, const std::string& child,
                                                  const urban_nav_core::Pose& T_parent_child);

/// The axes of an optical frame (z forward, x right, y down) in a body frame (x forward, y left, z up), REP-103.
urban_nav_core::Pose opticalInBody();

}  // namespace urban_nav_ros
