// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/recording.hpp"

#include <fstream>

#include "recording/bag_contents.hpp"
#include "recording/clock_steps.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

void throwDamaged(const std::string& path, const std::exception& found) {
  throw DataError(path, std::string("cannot be read: ") + found.what(),
                  "a whole bag (`rosbag reindex` mends one that was cut off)");
}

bool isBagFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic(7, '\0');
  return file.read(magic.data(), 7) && magic == "#ROSBAG";
}

urban_nav_core::StampNs RecordedMessage::receipt() const { return urban_nav_ros::toStampNs(instance_.getTime()); }

RecordedMessages::RecordedMessages(Recording& recording, const std::vector<std::string>& topics,
                                   const ReceiptRange& range) {
  auto path = recording.paths().begin();
  for (rosbag::Bag& bag : recording.bags()) {
    File& file = files_.emplace_back();
    file.path = &*path++;
    addToView(file.view, bag, topics, range);
    size_ += file.view.size();
  }
  file_ = files_.begin();
  if (file_ != files_.end()) position_ = file_->view.begin();
}

std::optional<RecordedMessage> RecordedMessages::next() {
  while (file_ != files_.end() && position_ == file_->view.end())
    if (++file_ != files_.end()) position_ = file_->view.begin();
  if (file_ == files_.end()) return std::nullopt;
  try {
    RecordedMessage message(*position_, *file_->path);
    ++position_;
    return message;
  } catch (const rosbag::BagException& error) {
    throwDamaged(*file_->path, error);
  }
}

Recording::Recording(const std::vector<std::string>& paths) : paths_(paths) {
  for (const std::string& path : paths_) {
    if (!isBagFile(path)) throw UserError(path, "is not a recording", "a bag");
    try {
      bags_.emplace_back(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagUnindexedException&) {
      throw DataError(path, "has no index: the recording was cut off (rosbag reindex " + path + " repairs that)", "");
    } catch (const rosbag::BagException& error) {
      throwDamaged(path, error);
    }
  }
}

std::map<std::string, std::string> Recording::topicTypes() { return urban_nav_input::topicTypes(bags_); }

urban_nav_ros::StaticTransforms Recording::transforms() {
  try {
    return readTransforms(bags_);
  } catch (const rosbag::BagException& error) {
    throwDamaged(paths_.front(), error);
  }
}

urban_nav_core::StampNs Recording::begin() {
  rosbag::View view;
  for (rosbag::Bag& bag : bags_) view.addQuery(bag);
  return view.size() == 0 ? 0 : urban_nav_ros::toStampNs(view.getBeginTime());
}

RecordedMessages Recording::messages(const std::vector<std::string>& topics, const ReceiptRange& range) {
  return RecordedMessages(*this, topics, range);
}

}  // namespace urban_nav_input
