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

sensor_msgs::PointCloud2 toCloudMessage(const urban_nav_core::CloudView& view, const std::string& frame) {
  sensor_msgs::PointCloud2 message;
  message.header.stamp = toRosTime(view.stamp);
  message.header.frame_id = frame;
  message.width = view.width;
  message.height = view.height;
  message.point_step = static_cast<std::uint32_t>(view.point_step);
  message.row_step = static_cast<std::uint32_t>(view.row_step);
  message.is_bigendian = view.is_big_endian ? 1 : 0;
  message.is_dense = 0;  // points without a return may be NaN
  for (const urban_nav_core::CloudField& field : view.fields) {
    sensor_msgs::PointField& named = message.fields.emplace_back();
    named.name = field.name;
    named.offset = field.offset;
    named.datatype = static_cast<std::uint8_t>(field.number);
    named.count = field.count;
  }
  message.data.assign(view.data, view.data + view.size);
  return message;
}

}  // namespace urban_nav_ros
