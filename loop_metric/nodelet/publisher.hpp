// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "live/closure_verifier.hpp"

namespace loop_metric {

/// Topics of the stage. Thread-safe.
class Publisher {
 public:
  Publisher(ros::NodeHandle& nh, std::string base_frame);

  /// Publishes a verdict, and a picture if there are subscribers: of the clouds if they were aligned, otherwise of the
  /// two keyframes.
  void publish(const ClosureVerifier::Verdict& verdict);

 private:
  void publishPicture(const ClosureVerifier::Verdict& verdict);

  const std::string base_frame_;
  ros::Publisher metric_, matches_;
};

}  // namespace loop_metric
