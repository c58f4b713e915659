// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/results/place_topics.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/CompressedImage.h>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {

using urban_nav_store::StoredPlace;

namespace topics = urban_nav_ros::topics;

namespace {

constexpr const char* kUsedPlace = "used";  // status of a place that can be recognised

}  // namespace

void writePlaceTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording) {
  for (const urban_nav_store::StoredTrajectory& session : map.sessions()) {
    urban_nav_store::TableStore<StoredPlace>(store).forEach(session.session.id, [&](const StoredPlace& place) {
      const auto pose = map.poseAt(place.session, place.stamp);
      if (!pose) return;
      if (place.status == kUsedPlace) {
        geometry_msgs::PoseStamped message;
        message.header.stamp = urban_nav_ros::toRosTime(place.stamp);
        message.header.frame_id = map.frame();
        message.pose = urban_nav_ros::toPoseMessage(*pose);
        recording.write(topics::results::kPlaces, place.stamp, message);
      }
      if (place.thumbnail.empty()) return;
      sensor_msgs::CompressedImage image;
      image.header.stamp = urban_nav_ros::toRosTime(place.stamp);
      image.header.frame_id = urban_nav_core::frames::kBaseLink;
      image.format = "jpeg";
      image.data.assign(place.thumbnail.begin(), place.thumbnail.end());
      recording.write(topics::results::kPlaceImages, place.stamp, image);
    });
  }
}

}  // namespace urban_nav
