// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/cloud_view.hpp"

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

urban_nav_core::CloudView toCloudView(const sensor_msgs::PointCloud2& message) {
  urban_nav_core::CloudView view;
  view.stamp = toStampNs(message.header.stamp);
  view.width = message.width;
  view.height = message.height;
  view.point_step = message.point_step;
  view.row_step = message.row_step;
  view.is_big_endian = message.is_bigendian != 0;
  for (const sensor_msgs::PointField& field : message.fields)
    view.fields.push_back(
        {field.name, field.offset, static_cast<urban_nav_core::CloudField::Number>(field.datatype), field.count});
  view.data = message.data.data();
  view.size = message.data.size();
  return view;
}

}  // namespace urban_nav_ros
