// SPDX-License-Identifier: BSD-3-Clause
#include "session/lidar_stream.hpp"

#include <utility>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_input {

using urban_nav_core::CloudConvention;
using urban_nav_core::StampNs;

LidarStream::LidarStream(InputStream stream, const urban_nav_core::Pose& T_base_lidar,
                         urban_nav_core::CloudOptions options, StampNs delay)
    : stream_(std::move(stream)), T_base_lidar_(T_base_lidar), options_(std::move(options)), delay_(delay) {
  setConvention({});
}

void LidarStream::setConvention(CloudConvention convention) {
  convention_ = std::move(convention);
  reader_.emplace(convention_, options_);
  examination_.emplace(stream_.topic, convention_, options_.nearest);
}

std::optional<SweepInput> LidarStream::read(const urban_nav_core::CloudView& cloud) {
  urban_nav_core::ReadSweep read = reader_->read(cloud);
  const bool is_late = last_ != 0 && read.sweep.reference - delay_ <= last_;
  examination_->add(read, is_late);
  if (read.sweep.beams.empty() || is_late) return std::nullopt;
  SweepInput input{stream_.role, T_base_lidar_, std::move(read.sweep)};
  input.sweep.reference -= delay_;
  if (delay_ != 0)
    for (urban_nav_core::Beam& beam : input.sweep.beams) beam.stamp -= delay_;
  last_ = input.sweep.reference;
  return input;
}

InputStream LidarStream::describe() const {
  InputStream stream = stream_;
  InputStream::Lidar lidar;
  lidar.T_base_lidar = T_base_lidar_;
  if (!options_.are_deskewed) lidar.times = convention_.times;
  lidar.sweep_s = convention_.sweep_s;
  lidar.rings = convention_.are_rings_known ? static_cast<int>(convention_.ring_count) : 0;
  lidar.deskewed = options_.are_deskewed;
  stream.lidar = lidar;
  return stream;
}

std::string LidarStream::note() const {
  const InputStream::Lidar lidar = *describe().lidar;
  std::string text = stream_.role + ": " + stream_.topic + ", sweeps of " +
                     urban_nav_core::formatNumber(lidar.sweep_s, 3) + " s" +
                     (lidar.rings > 0 ? ", " + std::to_string(lidar.rings) + " rings" : "");
  if (lidar.deskewed) return text + ", deskewed already";
  if (!lidar.times.areKnown()) return text + ", without times of points: not deskewed";
  return text + ", times of points in field " + lidar.times.field + " (" + toString(lidar.times.unit) + ", " +
         (lidar.times.reference == urban_nav_core::PointTimes::Reference::Header ? "relative to the header"
                                                                                 : "absolute") +
         ")";
}

void LidarStream::archive(urban_nav_core::Archive& archive) {
  CloudConvention convention = convention_;
  archive(T_base_lidar_, stream_.frame, convention);
  if (archive.isReading()) setConvention(std::move(convention));
  archive(*examination_, last_);
}

urban_nav_core::CloudOptions toCloudOptions(const PointsOptions& points, bool are_deskewed) {
  urban_nav_core::CloudOptions options;
  options.times = points.times;
  options.are_deskewed = points.deskewed.value_or(are_deskewed);
  options.nearest = points.near;
  return options;
}

}  // namespace urban_nav_input
