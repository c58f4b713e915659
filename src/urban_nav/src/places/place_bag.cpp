// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <limits>
#include <map>

#include "input/bag_topics.hpp"
#include "places/place_source.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t panorama_cameras = 5;
constexpr StampNs same_panorama = 20'000'000;         // ns between stamps of the cameras of one panorama
constexpr StampNs panorama_patience = 1'000'000'000;  // ns: a camera later than that is missing

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Topics by role: those that the user names, then those of the panorama's five cameras.
std::map<std::string, std::size_t> cameraTopics(const std::map<std::string, std::string>& available,
                                                const std::vector<std::string>& wishes,
                                                std::vector<std::string>& notes) {
  std::map<std::string, std::size_t> cameras;
  std::vector<std::string> others;
  for (const std::string& wish : wishes) {
    const std::size_t sign = wish.find(":=");
    if (wish.rfind("panorama", 0) != 0 || sign != 9 || wish[8] < '0' ||
        wish[8] >= '0' + static_cast<char>(panorama_cameras)) {
      others.push_back(wish);
      continue;
    }
    const std::string name = wish.substr(sign + 2);
    if (available.count(name) == 0)
      throw UserError("--topic", "\"" + name + "\" is not in the bag", "one of its image topics");
    cameras[name] = static_cast<std::size_t>(wish[8] - '0');
  }
  if (!cameras.empty()) return cameras;
  for (std::size_t camera = 0; camera < panorama_cameras; ++camera)
    for (const auto& [name, type] : available)
      if (isImageType(type) && (holds(name, "ladybug") || holds(name, "panorama")) &&
          holds(name, "camera" + std::to_string(camera)) && cameras.count(name) == 0) {
        cameras[name] = camera;
        break;
      }
  if (cameras.size() > 1) {
    notes.push_back(std::to_string(cameras.size()) + " cameras of a panorama: " + cameras.begin()->first + " ...");
    return cameras;
  }
  cameras.clear();
  const BagTopics topics = chooseTopics(available, others);
  if (const auto left = topics.find(Role::Left)) {
    notes.push_back("no panoramas: left images, " + left->name);
    cameras[left->name] = 0;
  }
  return cameras;
}

class PlaceBag : public PlaceSource {
 public:
  PlaceBag(const std::string& path, const std::vector<std::string>& wishes) : path_(path) {
    try {
      bag_.open(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagException& error) {
      throw UserError(path, std::string("is no bag: ") + error.what(), "a folder of images or a bag");
    }
    std::map<std::string, std::string> available;
    rosbag::View all(bag_);
    for (const rosbag::ConnectionInfo* connection : all.getConnections())
      available[connection->topic] = connection->datatype;
    cameras_ = cameraTopics(available, wishes, notes_);
    if (cameras_.empty())
      throw DataError(path, "has no topics of images that are known",
                      "--topic panorama0:=NAME ... or --topic left:=NAME");
    for (const auto& [name, camera] : cameras_) count_ = std::max(count_, camera + 1);
    std::vector<std::string> names;
    for (const auto& [name, camera] : cameras_) names.push_back(name);
    view_ = std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(names));
    next_ = view_->begin();
    expected_ = view_->size() / cameras_.size();
  }

  const std::string& path() const override { return path_; }
  std::size_t expected() const override { return expected_; }
  const std::vector<std::string>& notes() const override { return notes_; }

  std::optional<PlaceImages> next() override {
    try {
      for (; next_ != view_->end(); ++next_) {
        add(*next_);
        if (isReady()) {
          ++next_;
          return takeOldest();
        }
      }
    } catch (const std::exception& error) {
      throw DataError(path_, std::string("is damaged: ") + error.what(), "");
    }
    if (waiting_.empty()) return std::nullopt;
    return takeOldest();
  }

 private:
  void add(const rosbag::MessageInstance& instance) {
    const std::size_t camera = cameras_.at(instance.getTopic());
    urban_nav_ros::GreyImage image;
    StampNs stamp = 0;
    if (const auto raw = instance.instantiate<sensor_msgs::Image>()) {
      stamp = urban_nav_ros::toStampNs(raw->header.stamp);
      image = urban_nav_ros::toGrey(*raw);
      image.pixels = image.pixels.clone();  // mono8 lives as long as the message
    } else if (const auto compressed = instance.instantiate<sensor_msgs::CompressedImage>()) {
      stamp = urban_nav_ros::toStampNs(compressed->header.stamp);
      image = urban_nav_ros::toGrey(*compressed);
    }
    if (image.pixels.empty() || stamp <= last_) return;
    newest_ = std::max(newest_, stamp);
    auto at = waiting_.lower_bound(stamp - same_panorama);
    if (at == waiting_.end() || at->first > stamp + same_panorama)
      at = waiting_.emplace(stamp, std::vector<cv::Mat>(count_)).first;
    at->second[camera] = image.pixels;
  }

  bool isReady() const {
    if (waiting_.empty()) return false;
    std::size_t images = 0;
    for (const cv::Mat& image : waiting_.begin()->second) images += image.empty() ? 0u : 1u;
    return images == cameras_.size() || newest_ - waiting_.begin()->first > panorama_patience;
  }

  PlaceImages takeOldest() {
    PlaceImages images{waiting_.begin()->first, std::move(waiting_.begin()->second)};
    waiting_.erase(waiting_.begin());
    last_ = images.stamp;
    return images;
  }

  std::string path_;
  rosbag::Bag bag_;
  std::map<std::string, std::size_t> cameras_;
  std::size_t count_ = 0, expected_ = 0;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
  std::map<StampNs, std::vector<cv::Mat>> waiting_;
  StampNs newest_ = 0, last_ = std::numeric_limits<StampNs>::min();
  std::vector<std::string> notes_;
};

}  // namespace

std::unique_ptr<PlaceSource> openPlaceBag(const std::string& path, const std::vector<std::string>& topics) {
  return std::make_unique<PlaceBag>(path, topics);
}

}  // namespace urban_nav
