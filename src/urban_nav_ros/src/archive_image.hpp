// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Image.h>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_ros {

/// Reads or writes an image message, exactly. A plane of bytes is stored as PNG, half its size. Throws DataError for
/// damaged bytes.
void archiveImage(urban_nav_core::Archive& archive, sensor_msgs::ImageConstPtr& message);

}  // namespace urban_nav_ros
