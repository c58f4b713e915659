// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/drive/side_drive.hpp"

namespace scene_labeler {

using urban_nav_core::StampNs;

SideDrive::SideDrive(SideRig rig, const urban_nav_core::Trajectory& T_world_base, const TravelledPath& path,
                     double spacing, DriveWindow& window)
    : rig_(std::move(rig)),
      T_world_base_(T_world_base),
      path_(path),
      spacing_(spacing),
      window_(window),
      renderer_(T_world_base, rig_.T_base_laser, urban_nav_core::Pose(), kLongestPoseGap) {}

void SideDrive::add(const urban_nav_core::PlanarScan& planar) {
  const auto travelled = path_.at(planar.stamp);
  if (!travelled || *travelled < latest_) return;
  latest_ = *travelled;
  const double wait = rig_.camera ? spacing_ : 0.0;
  if (latest_ >= next_ + wait) addFrame({planar.stamp, latest_, {}});
  points_.clear();
  const urban_nav_core::Scan scan = urban_nav_core::toScan(planar);
  renderer_.render(scan, points_);
  std::size_t beam = 0, index = 0;  // of scan.beams and of planar.ranges, which omit different elements
  for (const urban_nav_core::LaserPoint& point : points_) {
    while (planar.ranges[index] != scan.beams[beam].range) ++index;
    while (scan.beams[beam].stamp != point.stamp || scan.beams[beam].range != point.range) {
      ++beam;
      ++index;
      while (planar.ranges[index] != scan.beams[beam].range) ++index;
    }
    window_.add(DriveReturn{planar.stamp, static_cast<std::uint16_t>(index), point.intensity, latest_, point.p,
                            point.origin - point.p});
    ++beam;
    ++index;
  }
}

bool SideDrive::wants(StampNs stamp) const {
  const auto travelled = path_.at(stamp);
  return rig_.camera && travelled && *travelled >= next_;
}

void SideDrive::add(StampNs stamp, const cv::Mat& image, const cv::Mat& classes) {
  const auto T_world_base = T_world_base_.at(stamp, kLongestPoseGap);
  if (!wants(stamp) || !T_world_base || image.type() != CV_8UC3) return;
  const urban_nav_core::Pinhole& pinhole = rig_.camera->raw.pinhole;
  if (image.cols != pinhole.width || image.rows != pinhole.height) return;
  addFrame({stamp, *path_.at(stamp), {rig_.camera->raw, *T_world_base * rig_.camera->T_base_camera, image, classes}});
}

void SideDrive::addFrame(DriveFrame frame) {
  next_ = frame.travelled + spacing_;
  window_.add(std::move(frame));
}

}  // namespace scene_labeler
