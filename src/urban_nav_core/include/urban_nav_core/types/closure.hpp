// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Identifies the pose of base_link at a time of a session, independently of the pose graph. `session`: an id; empty is
/// the session being recorded.
struct PoseRef {
  std::string session;
  StampNs stamp = 0;
};
bool operator==(const PoseRef& a, const PoseRef& b);
bool operator<(const PoseRef& a, const PoseRef& b);
/// Prints "1225719873.501685001 s", preceded by the session and a blank if there is one.
std::ostream& operator<<(std::ostream& out, const PoseRef& ref);

/// Two times at which the robot was at the same place (Newman et al. 2009, section 3), without a transform.
struct TopologicalClosure {
  PoseRef a, b;  ///< b is the later one, at which a was recognised
  double probability = 0.0;
};

/// Method by which the transform of a closure was measured.
enum class ClosureMethod { None, Stereo, Icp };
/// Returns "none", "stereo" or "icp".
const char* toString(ClosureMethod method);
std::optional<ClosureMethod> parseClosureMethod(std::string_view word);

/// State of a closure, from its measurement to the pose graph.
enum class ClosureVerdict {
  Accepted,    ///< the transform is correct in all directions, to its covariance
  Rejected,    ///< an outlier, or there is no transform
  Waiting,     ///< undecided: the transform is not measured, or the graph lacks a second closure that supports it
  Degenerate,  ///< alignments only: correct except along the given free directions
};
/// Returns "accepted", "rejected", "waiting" or "degenerate".
const char* toString(ClosureVerdict verdict);
std::optional<ClosureVerdict> parseClosureVerdict(std::string_view word);

/// Closure with its transform, or the reason why there is none. The information is zero unless the verdict is Accepted.
struct MetricClosure {
  PoseRef a, b;
  Constraint measured;                    ///< T_a_b
  std::vector<Vector6d> free_directions;  ///< unit tangents (rho, phi) without information
  double probability = 0.0;               ///< that both places are the same, from place recognition
  ClosureMethod method = ClosureMethod::None;
  bool odometry_gate = false;  ///< the transform is consistent with odometry, where odometry is available
  ClosureVerdict verdict = ClosureVerdict::Rejected;
  int reason = 0;  ///< enumerator of the stage that decided; 0: none
  std::string reason_name, sentence;
  std::string evidence;  ///< description by that stage, for `why`
  std::string source;    ///< that stage ("loop_metric")
};

/// Transform between two times from any other source: re-observed planes, a user's assertion.
struct RelativeConstraint {
  PoseRef a, b;
  Constraint measured;  ///< origin ("laser_mapper")
  std::string kind;     ///< "plane", "asserted"
  std::string source;   ///< stage or user that states it ("laser_mapper")
};

}  // namespace urban_nav_core
