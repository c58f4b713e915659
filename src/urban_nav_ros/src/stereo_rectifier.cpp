// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_rectifier.hpp"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/baseline_check.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::ImageView;

namespace {

/// Returns the header of the message with the stamp of the input.
std_msgs::Header makeHeader(const ImageInput& image) {
  std_msgs::Header header = std::visit([](const auto& message) { return message->header; }, image.message);
  header.stamp = toRosTime(image.stamp);
  return header;
}

/// Returns a message with the pixels of the view, which may be those of `rectified`.
sensor_msgs::ImageConstPtr toMono8(const std_msgs::Header& header, const ImageView& view,
                                   std::vector<std::uint8_t>&& rectified) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = sensor_msgs::image_encodings::MONO8;
  message->width = static_cast<std::uint32_t>(view.width);
  message->height = static_cast<std::uint32_t>(view.height);
  message->step = message->width;
  const std::size_t size = static_cast<std::size_t>(message->step) * message->height;
  if (view.data == rectified.data() && rectified.size() == size && view.stride == view.width) {
    message->data = std::move(rectified);
    return message;
  }
  message->data.reserve(size);
  for (int v = 0; v < view.height; ++v)
    message->data.insert(message->data.end(), view.row(v), view.row(v) + view.width);
  return message;
}

}  // namespace

void StereoRectifier::handle(const InfoInput& info) {
  sensor_msgs::CameraInfoConstPtr& known = info.side == Side::Left ? left_info_ : right_info_;
  if (known && isSameCalibration(*known, *info.message)) return;
  // A new left camera does not match the old right one: wait for the other camera_info.
  if (known) {
    (info.side == Side::Left ? right_info_ : left_info_).reset();
    judge_.reset();
  }
  known = info.message;
  calibration_.reset();
  fault_.clear();
  forgetStream();
  if (left_info_ && right_info_) calibrate();
}

void StereoRectifier::calibrate() {
  const bool must_decide = waiting_.size() >= static_cast<std::size_t>(options_.queue);
  try {
    const urban_nav_core::CameraInfo left = toCameraInfo(*left_info_), right = toCameraInfo(*right_info_);
    const std::optional<bool> are_rectified = judge_.decide(left, right, options_.where, must_decide);
    if (!are_rectified) return;
    calibration_.emplace(left, right, *are_rectified, options_.where);
    if (!judge_.contradiction().empty()) listener_.fault(judge_.contradiction());
  } catch (const urban_nav_core::Error& error) {
    fault_ = error.what();
    listener_.fault(fault_);
    return;
  }
  for (const ImageInput& image : std::exchange(waiting_, {})) process(image);
}

void StereoRectifier::handle(ImageInput image) {
  if (image.side == Side::Right) image.stamp -= options_.right_delay;
  if (images_.add(image.stamp)) forgetStream();
  if (calibration_) return process(image);
  waiting_.push_back(image);
  judge_.add(image);
  if (left_info_ && right_info_ && fault_.empty()) calibrate();
  if (waiting_.size() <= static_cast<std::size_t>(options_.queue)) return;
  waiting_.pop_front();
  ++counts_.dropped;
}

void StereoRectifier::reset() {
  waiting_.clear();
  images_.reset();
  forgetStream();
}

void StereoRectifier::forgetStream() { range_ = GreyRange(); }

void StereoRectifier::process(const ImageInput& image) {
  std::string fault;
  sensor_msgs::ImageConstPtr message = convert(image, fault);
  if (!fault.empty()) {
    ++counts_.damaged;
    listener_.fault((image.side == Side::Left ? "left image: " : "right image: ") + fault);
    message = toMono8(makeHeader(image), {}, {});
  }
  listener_.image(image.side, message);
}

sensor_msgs::ImageConstPtr StereoRectifier::convert(const ImageInput& image, std::string& fault) {
  GreyImage grey;
  const auto* raw = std::get_if<sensor_msgs::ImageConstPtr>(&image.message);
  if (raw != nullptr) {
    range_.add(**raw);
    grey = toGrey(**raw, range_.scale());
  } else {
    const auto& packed = *std::get<sensor_msgs::CompressedImageConstPtr>(image.message);
    range_.add(packed);
    grey = toGrey(packed, range_.scale());
  }
  fault = grey.fault;
  if (!fault.empty()) return nullptr;
  std::vector<std::uint8_t> rectified;
  const ImageView view = calibration_->rectify(image.side, toView(grey.pixels), rectified);
  if (view.empty()) {
    fault = std::to_string(grey.pixels.cols) + "x" + std::to_string(grey.pixels.rows) +
            ", which is not the size in camera_info";
    return nullptr;
  }
  ++(calibration_->rectifies() ? counts_.rectified : counts_.passed);
  const bool is_unchanged = raw != nullptr && image.stamp == toStampNs((*raw)->header.stamp) &&
                            !calibration_->rectifies() && (*raw)->encoding == sensor_msgs::image_encodings::MONO8;
  return is_unchanged ? *raw : toMono8(makeHeader(image), view, std::move(rectified));
}

urban_nav_live::StageReport StereoRectifier::report() const {
  urban_nav_live::StageReport report;
  if (!calibration_) {
    report.is_warning = true;
    report.summary = fault_.empty() ? "no calibration yet" : fault_;
  } else {
    report.warn(describeBaseline(calibration_->camera().baseline));
  }
  report.add("images rectified", counts_.rectified);
  report.add("images passed through", counts_.passed);
  report.add("images damaged", counts_.damaged);
  report.add("dropped: before the calibration", counts_.dropped);
  return report;
}

}  // namespace urban_nav_ros
