// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// The robot's base_link at a time of a session: how stages name a pose of the trajectory to each other, whatever the
/// pose graph makes of it. `session`: an id; empty is the session that is being recorded.
struct PoseRef {
  std::string session;
  StampNs stamp = 0;
};
bool operator==(const PoseRef& a, const PoseRef& b);
bool operator<(const PoseRef& a, const PoseRef& b);
/// "1225719873.501685001 s", after the session and a blank where there is one.
std::ostream& operator<<(std::ostream& out, const PoseRef& ref);

/// Two times at which the robot saw the same place (Newman et al. 2009, section 3): no transform.
struct TopologicalClosure {
  PoseRef a, b;  ///< b is the later one, whose recognition it is
  double probability = 0.0;
};

/// What the transform of a closure was measured with.
enum class ClosureMethod { None, Stereo, Icp };
/// "none", "stereo", "icp".
const char* toString(ClosureMethod method);
std::optional<ClosureMethod> parseClosureMethod(std::string_view word);

/// The state of a closure, from its measurement to the pose graph.
enum class ClosureVerdict {
  Accepted,    ///< the transform is right in all its directions, to its covariance
  Rejected,    ///< an outlier, or there is no transform
  Waiting,     ///< not decided: the transform is not measured, or the graph lacks a second closure that supports it
  Degenerate,  ///< of an alignment alone: right but for the directions that it names free
};
/// "accepted", "rejected", "waiting", "degenerate".
const char* toString(ClosureVerdict verdict);
std::optional<ClosureVerdict> parseClosureVerdict(std::string_view word);

/// A closure with its transform, or why there is none. The information is zero unless the verdict is Accepted.
struct MetricClosure {
  PoseRef a, b;
  Constraint measured;                    ///< T_a_b
  std::vector<Vector6d> free_directions;  ///< unit tangents (rho, phi) along which nothing is known
  double probability = 0.0;               ///< of the places being one, as the recognition said
  ClosureMethod method = ClosureMethod::None;
  bool odometry_gate = false;  ///< the transform is one that odometry allows, as far as it goes
  ClosureVerdict verdict = ClosureVerdict::Rejected;
  int reason = 0;  ///< enumerator of the stage that decided, 0: none
  std::string reason_name, sentence;
  std::string evidence;  ///< in the words of that stage, for `why`
  std::string source;    ///< that stage ("loop_metric")
};

/// A transform between two times that any other stage has found: planes seen again, a person.
struct RelativeConstraint {
  PoseRef a, b;
  Constraint measured;  ///< T_a_b
  std::string kind;     ///< "plane", "asserted"
  std::string source;   ///< who says so ("laser_mapper")
};

}  // namespace urban_nav_core
