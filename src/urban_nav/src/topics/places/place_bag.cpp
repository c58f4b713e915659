// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <deque>
#include <map>

#include "topics/places/place_source.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/grey_survey.hpp"
#include "urban_nav_ros/panorama_feed.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::UserError;
using urban_nav_ros::PanoramaFeed;
using urban_nav_ros::RecordedImage;

namespace {

/// Topics of the cameras, in order: those of a panoramic head, else the left camera.
struct PlaceTopics {
  std::vector<std::string> topics;
  std::vector<std::size_t> numbers;  ///< of each about the vertical axis
  std::vector<std::string> notes;
};

PlaceTopics choosePlaceTopics(const std::map<std::string, std::string>& available,
                              const std::vector<std::string>& wishes) {
  const urban_nav_input::BagTopics chosen = urban_nav_input::chooseTopics(available, wishes);
  PlaceTopics found;
  for (const std::size_t camera : chosen.panorama()) {
    found.topics.push_back(chosen.find(urban_nav_input::panoramaRole(camera))->name);
    found.numbers.push_back(camera);
  }
  if (!found.topics.empty()) {
    found.notes.push_back(std::to_string(found.topics.size()) + " cameras of a panorama: " + found.topics.front() +
                          (found.topics.size() > 1 ? " ..." : ""));
  } else if (const auto left = chosen.find(urban_nav_input::Role::Left)) {
    found = {{left->name}, {0}, {"no panoramas: left images, " + left->name}};
  }
  return found;
}

class PlaceBag : public PlaceSource {
 public:
  PlaceBag(const std::string& path, const std::vector<std::string>& wishes) : path_(path), recording_(path) {
    topics_ = choosePlaceTopics(recording_.topicTypes(), wishes);
    if (topics_.topics.empty())
      throw DataError(path, "has no topics of images that are known",
                      "--topic panorama0:=NAME ... or --topic left:=NAME");
    PanoramaFeed::Options options;
    options.cameras = topics_.topics.size();
    feed_.emplace(options);
    feed_->expectRange(urban_nav_input::surveyGreyRange(recording_, topics_.topics));
    messages_.emplace(recording_.messages(topics_.topics));
  }

  const std::string& path() const override { return path_; }
  std::size_t expected() const override { return messages_->size() / topics_.topics.size(); }
  const std::vector<std::string>& notes() const override { return topics_.notes; }

  std::optional<PlaceImages> next() override {
    try {
      while (true) {
        if (const auto panorama = feed_->take()) {
          PlaceImages images = decode(*panorama);
          if (std::any_of(images.grey.begin(), images.grey.end(), [](const cv::Mat& grey) { return !grey.empty(); }))
            return images;
          continue;
        }
        if (ended_) return std::nullopt;
        if (const auto message = messages_->next()) {
          add(*message);
        } else {
          feed_->finish();
          ended_ = true;
        }
      }
    } catch (const std::exception& error) {
      throw DataError(path_, std::string("is damaged: ") + error.what(), "");
    }
  }

 private:
  void add(const urban_nav_input::RecordedMessage& message) {
    const auto topic = std::find(topics_.topics.begin(), topics_.topics.end(), message.topic());
    const auto camera = static_cast<std::size_t>(topic - topics_.topics.begin());
    if (const auto raw = message.as<sensor_msgs::Image>())
      feed_->add(camera, RecordedImage(sensor_msgs::ImageConstPtr(raw)));
    else if (const auto compressed = message.as<sensor_msgs::CompressedImage>())
      feed_->add(camera, RecordedImage(sensor_msgs::CompressedImageConstPtr(compressed)));
  }

  PlaceImages decode(const urban_nav_ros::Panorama& panorama) const {
    PlaceImages images{panorama.stamp, std::vector<cv::Mat>(topics_.numbers.back() + 1)};
    for (std::size_t i = 0; i < panorama.images.size(); ++i)
      if (!panorama.images[i].empty()) images.grey[topics_.numbers[i]] = panorama.images[i].grey().pixels;
    return images;
  }

  std::string path_;
  urban_nav_input::Recording recording_;
  PlaceTopics topics_;
  std::optional<PanoramaFeed> feed_;
  std::optional<urban_nav_input::RecordedMessages> messages_;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<PlaceSource> openPlaceBag(const std::string& path, const std::vector<std::string>& topics) {
  return std::make_unique<PlaceBag>(path, topics);
}

}  // namespace urban_nav
