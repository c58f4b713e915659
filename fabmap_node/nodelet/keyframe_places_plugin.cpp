// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "fabmap_node/retrieval/keyframe_places.hpp"

PLUGINLIB_EXPORT_CLASS(fabmap_node::KeyframePlaces, urban_nav_registration::KeyframeRetrieval)
