// SPDX-License-Identifier: BSD-3-Clause
#include "folder/kitti_sweep_stream.hpp"

#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"

namespace urban_nav_input {

namespace {

/// Returns the options of a folder: times follow from the directions of points (KittiCloud), unless the user
/// states that times are missing.
urban_nav_core::CloudOptions chooseOptions(const KittiSweepLayout& layout, const PointsOptions& points) {
  if (points.times && points.times->areKnown())
    throw urban_nav_core::UserError("input.points_time",
                                    "the sweeps of " + layout.folder + " have no field \"" + points.times->field + "\"",
                                    "auto or none");
  urban_nav_core::CloudOptions options = toCloudOptions(points, layout.is_deskewed);
  if (!points.times)
    options.times = urban_nav_core::PointTimes{"azimuth", urban_nav_core::PointTimes::Unit::Seconds,
                                               urban_nav_core::PointTimes::Reference::Header};
  options.refer_to_header = true;
  return options;
}

}  // namespace

KittiSweepStream::KittiSweepStream(const KittiSweepLayout& layout, const urban_nav_core::Pose& T_base_camera,
                                   const SourceOptions& options)
    : files_(stampKittiSweeps(layout, options.rate, notes_)) {
  const std::optional<urban_nav_core::Pose> T_camera_lidar = readKittiLidar(layout.folder);
  if (!T_camera_lidar) {
    notes_.push_back(layout.files +
                     " is not used: there is no row Tr in calib.txt, and no calib_velo_to_cam.txt, so the pose of the "
                     "LiDAR is unknown");
    return;
  }
  InputStream stream;
  stream.role = toString(pointsRole(0));
  stream.topic = layout.name;
  stream.frame = "velodyne";
  stream.messages = static_cast<std::int64_t>(files_.size());
  stream_.emplace(stream, T_base_camera * *T_camera_lidar, chooseOptions(layout, options.points), 0);
  survey();
}

void KittiSweepStream::survey() {
  urban_nav_core::CloudSurvey survey(stream_->options());
  for (const auto& [stamp, path] : files_) {
    if (survey.isComplete()) break;
    survey.add(KittiCloud(path, stamp).view());
  }
  const urban_nav_core::CloudConvention convention = survey.conclude();
  if (convention.clouds == 0) {
    notes_.push_back(stream_->topic() + ": no valid points in any of its " + std::to_string(files_.size()) +
                     " sweeps: all are NaN or at the origin, or their files cannot be read; it is not used");
    stream_.reset();
    return;
  }
  stream_->setConvention(convention);
  notes_.push_back(stream_->note());
}

std::optional<urban_nav_core::StampNs> KittiSweepStream::nextStamp() const {
  if (!stream_ || position_ >= files_.size()) return std::nullopt;
  return files_[position_].first;
}

std::optional<SweepInput> KittiSweepStream::next() {
  const auto& [stamp, path] = files_[position_++];
  const KittiCloud cloud(path, stamp);
  if (!cloud.fault().empty() && cloud.view().size == 0) {
    stream_->addFault(cloud.fault());
    return std::nullopt;
  }
  return stream_->read(cloud.view());
}

}  // namespace urban_nav_input
