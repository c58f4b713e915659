// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/RelativeConstraint.h>
#include <urban_nav_msgs/TopologicalClosure.h>

#include <optional>
#include <string>

#include "urban_nav_core/types/closure.hpp"

namespace urban_nav_ros {

urban_nav_msgs::PoseRef toPoseRefMessage(const urban_nav_core::PoseRef& ref);
urban_nav_core::PoseRef toPoseRef(const urban_nav_msgs::PoseRef& message);

/// Conversions of closures. Messages are validated: the result is empty for numbers that are not finite, an invalid
/// pose, a probability outside 0...1, an unknown enumerator, free directions that do not have six elements, or
/// information that is not symmetric (to 1e-6 of its largest element). Indefinite information is rejected by the graph,
/// which names the edge.
urban_nav_msgs::TopologicalClosure toTopologicalClosureMessage(const urban_nav_core::TopologicalClosure& closure);
std::optional<urban_nav_core::TopologicalClosure> toTopologicalClosure(
    const urban_nav_msgs::TopologicalClosure& message);

/// Computes the covariance for display from the information; `length`, m: translation that counts as one rad
/// (urban_nav_core::covarianceForDisplay). It is not read back.
urban_nav_msgs::MetricClosure toMetricClosureMessage(const urban_nav_core::MetricClosure& closure,
                                                     const std::string& child_frame, double length);
std::optional<urban_nav_core::MetricClosure> toMetricClosure(const urban_nav_msgs::MetricClosure& message);

urban_nav_msgs::RelativeConstraint toRelativeConstraintMessage(const urban_nav_core::RelativeConstraint& constraint,
                                                               const std::string& child_frame);
std::optional<urban_nav_core::RelativeConstraint> toRelativeConstraint(
    const urban_nav_msgs::RelativeConstraint& message);

/// Converts a transform with information, the form of closures in messages and services.
std::optional<urban_nav_core::Constraint> toConstraint(const geometry_msgs::Pose& T_a_b,
                                                       const boost::array<double, 36>& information);

}  // namespace urban_nav_ros
