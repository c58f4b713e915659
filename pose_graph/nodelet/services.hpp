// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>

#include "live/graph_worker.hpp"
#include "urban_nav_ros/stage_node.hpp"

namespace pose_graph {

using GraphNode = urban_nav_ros::StageNodeWith<GraphWorker::Input>;

/// Advertises the services of the stage. Each request waits for the worker; ~optimize blocks until the batch has ended.
/// Files are read and copied in the caller's thread. `worker` must exist while `node` runs.
void advertiseServices(GraphNode& node, GraphWorker& worker);

}  // namespace pose_graph
