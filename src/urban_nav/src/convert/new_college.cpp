// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CompressedImage.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>

#include "convert/convert.hpp"
#include "convert/laser_topics.hpp"
#include "convert/row_check.hpp"
#include "convert/stereo_topics.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/folder/new_college_files.hpp"
#include "urban_nav_input/folder/new_college_log.hpp"
#include "urban_nav_input/folder/new_college_rig.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

namespace frames = urban_nav_core::frames;

using urban_nav_core::DataError;
using urban_nav_core::StampNs;

namespace {

constexpr double kRowsAgree = 0.3;  // px
constexpr std::size_t kPairsChecked = 3;

std::vector<geometry_msgs::TransformStamped> transforms() {
  std::vector<geometry_msgs::TransformStamped> all =
      stereoTransforms(urban_nav_input::newCollegeCamera(), urban_nav_input::newCollegeLeftCamera());
  all.push_back(
      urban_nav_ros::toStaticTransform(frames::kBaseLink, frames::kLaserLeft, urban_nav_input::newCollegeLeftLaser()));
  all.push_back(urban_nav_ros::toStaticTransform(frames::kBaseLink, frames::kLaserRight,
                                                 urban_nav_input::newCollegeRightLaser()));
  return all;
}

void write(const urban_nav_input::NewCollegeScan& event, BagWriter& bag) {
  urban_nav_core::PlanarScan scan = event.scan;
  scan.stamp = event.stamp;
  writeLaser(event.side == urban_nav_input::Side::Left ? "left" : "right", scan, static_cast<std::uint32_t>(event.id),
             bag);
}

void write(const urban_nav_input::NewCollegeOdometry& event, BagWriter& bag) {
  nav_msgs::Odometry message;
  message.header.stamp = urban_nav_ros::toRosTime(event.stamp);
  message.header.frame_id = frames::kOdom;
  message.child_frame_id = frames::kBaseLink;
  message.pose.pose = urban_nav_ros::toPoseMessage(event.T_odom_base);
  message.twist.twist.linear.x = event.speed;
  message.twist.twist.angular.y = event.pitch_rate;
  message.twist.twist.angular.z = event.yaw_rate;
  bag.write(urban_nav_ros::topics::fromRoot(urban_nav_ros::topics::kWheelOdometry), event.stamp, message);
}

void write(const urban_nav_input::NewCollegePanorama& /*event*/, BagWriter& /*bag*/) {
}  // only the index; images are stamped by their file names

void write(const urban_nav_input::NewCollegeFiles::Image& image, BagWriter& bag) {
  const urban_nav_ros::GreyImage seen = urban_nav_input::readPixels(image.path);
  if (seen.pixels.empty()) throw DataError("", seen.fault, "");
  std::ifstream file(image.path, std::ios::binary);
  sensor_msgs::CompressedImage message;
  message.header.stamp = urban_nav_ros::toRosTime(image.stamp);
  message.header.frame_id = frames::ladybugCamera(image.camera);
  message.format = "jpeg";
  message.data.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  const std::string topic = urban_nav_ros::topics::kPanoramaImages.at(static_cast<std::size_t>(image.camera));
  bag.write(urban_nav_ros::topics::fromRoot(topic + "/compressed"), image.stamp, message);
}

/// All data of one data set, in the order of stamps.
class NewCollege {
 public:
  explicit NewCollege(const std::string& source) : files_(urban_nav_input::findNewCollege(source)) {
    if (!files_.alog.empty()) log_.emplace(files_.alog);
    if (log_) event_ = log_->next();
  }

  StampNs first() const {
    StampNs stamp = event_ ? urban_nav_input::toStamp(*event_) : std::numeric_limits<StampNs>::max();
    if (!files_.stereo.empty()) stamp = std::min(stamp, files_.stereo.front().stamp);
    if (!files_.panorama.empty()) stamp = std::min(stamp, files_.panorama.front().stamp);
    return stamp;
  }

  void writeAll(BagWriter& bag, Progress& progress) {
    std::int64_t written = 0;
    for (; event_; event_ = log_->next()) {
      writeImagesUntil(urban_nav_input::toStamp(*event_), bag);
      std::visit([&](const auto& event) { write(event, bag); }, *event_);
      progress.update(++written);
    }
    writeImagesUntil(std::numeric_limits<StampNs>::max(), bag);
    progress.finish(written + static_cast<std::int64_t>(files_.stereo.size() + files_.panorama.size()));
  }

  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    if (!log_) notes.push_back("no .alog: no lasers, no odometry");
    if (files_.stereo.empty()) notes.push_back("no StereoImages");
    if (files_.panorama.empty()) notes.push_back("no images of the Ladybug");
    if (!files_.stereo.empty())
      notes.push_back("the pose of the stereo camera is unknown: assumed 0.1 m ahead and 1.1 m up");
    if (!row_differences_.empty()) {
      const double worst = *std::max_element(row_differences_.begin(), row_differences_.end());
      notes.push_back("rows of the stereo images agree to " + std::to_string(worst) + " px" +
                      (worst > kRowsAgree
                           ? ": they are NOT rectified, and the calibration without distortion does not fit them"
                           : ""));
    }
    if (lonely_ > 0) notes.push_back(std::to_string(lonely_) + " stereo images have no partner");
    if (log_) addLogNotes(notes);
    return notes;
  }

 private:
  void addLogNotes(std::vector<std::string>& notes) const {
    const urban_nav_input::NewCollegeCounts& counts = log_->counts();
    if (counts.scans_lost > 0)
      notes.push_back(std::to_string(counts.scans_lost) +
                      " laser scans were lost before the log (gaps in their numbers)");
    if (counts.odometry_without_tilt > 0)
      notes.push_back(std::to_string(counts.odometry_without_tilt) +
                      " odometry rows have no tilt: roll and pitch are 0");
    if (counts.out_of_order > 0)
      notes.push_back(std::to_string(counts.out_of_order) + " rows were more than 2 s late and are left out");
    std::string unused;
    for (const auto& [variable, rows] : counts.unused)
      unused += (unused.empty() ? "not used: " : ", ") + variable + " (" + std::to_string(rows) +
                (rows == 1 ? " row)" : " rows)");
    if (!unused.empty()) notes.push_back(unused);
  }

  void writeImagesUntil(StampNs stamp, BagWriter& bag) {
    for (; next_stereo_ < files_.stereo.size() && files_.stereo[next_stereo_].stamp <= stamp; ++next_stereo_)
      writePair(files_.stereo[next_stereo_], bag);
    for (; next_panorama_ < files_.panorama.size() && files_.panorama[next_panorama_].stamp <= stamp; ++next_panorama_)
      write(files_.panorama[next_panorama_], bag);
  }

  static cv::Mat read(const std::string& path, const urban_nav_core::Pinhole& size) {
    if (path.empty()) return {};
    const urban_nav_ros::GreyImage image = urban_nav_input::readGrey(path, {});
    if (image.pixels.empty()) throw DataError("", image.fault, "");
    if (image.pixels.cols != size.width || image.pixels.rows != size.height) {
      throw DataError(path, std::to_string(image.pixels.cols) + "x" + std::to_string(image.pixels.rows) + " pixels",
                      "512x384, which the data set's calibration is for");
    }
    return image.pixels;
  }

  void writePair(const urban_nav_input::NewCollegeFiles::Pair& files, BagWriter& bag) {
    const urban_nav_core::StereoCamera camera = urban_nav_input::newCollegeCamera();
    const cv::Mat left = read(files.left, camera.left), right = read(files.right, camera.left);
    if (left.empty() || right.empty()) ++lonely_;
    if (row_differences_.size() < kPairsChecked) {
      if (const std::optional<double> rows = rowDisagreement(left, right)) row_differences_.push_back(*rows);
    }
    const auto [left_view, left_owner] = urban_nav_input::sharedView(left);
    const auto [right_view, right_owner] = urban_nav_input::sharedView(right);
    writeStereo({files.stamp, left_view, right_view}, files.stamp, camera, bag);
  }

  const urban_nav_input::NewCollegeFiles files_;
  std::optional<urban_nav_input::NewCollegeLog> log_;
  std::optional<urban_nav_input::NewCollegeEvent> event_;
  std::size_t next_stereo_ = 0, next_panorama_ = 0;
  std::vector<double> row_differences_;
  std::int64_t lonely_ = 0;
};

}  // namespace

Converted convertNewCollege(const std::string& source, const std::string& path, Console& console) {
  NewCollege data(source);
  BagWriter bag(path);
  bag.writeStaticTransforms(data.first(), transforms());
  Progress progress(console, "convert", "rows", 0);
  data.writeAll(bag, progress);
  if (bag.counts().size() == 1) throw DataError(source, "holds no scans, odometry or images", "");
  bag.commit();
  return {bag.counts(), data.notes()};
}

}  // namespace urban_nav
