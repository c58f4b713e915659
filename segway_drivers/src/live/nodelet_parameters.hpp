// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace segway_drivers {

/// Parameters of a driver's nodelet; the keys of its device stand beside them in the private namespace, without the
/// name of the device.
struct NodeletParameters {
  std::string port;
  std::string frame;
  std::string base_frame;
  bool publish_tf;
  std::string session_begin;
  bool session_held;
  std::string paced_by;
  int queue;        // messages
  int image_queue;  // images

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace segway_drivers
