// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/session_bags.hpp"

#include <cmath>
#include <filesystem>
#include <utility>
#include <variant>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;

SessionBags::SessionBags(std::string path, double part, const urban_nav_sim::Session& session, CalibrationErrors errors)
    : path_(std::move(path)),
      part_(static_cast<StampNs>(std::llround(1e9 * part))),
      session_(session),
      errors_(std::move(errors)),
      messages_(session) {
  begin();
}

std::string SessionBags::makePath(std::size_t number) const {
  const std::filesystem::path whole(path_);
  return part_ == 0 ? path_
                    : (whole.parent_path() / whole.stem()).string() + "_" + std::to_string(number) +
                          whole.extension().string();
}

void SessionBags::begin() {
  const auto number = static_cast<StampNs>(paths_.size());
  paths_.push_back(makePath(paths_.size()));
  bag_.emplace(paths_.back());
  std::vector<geometry_msgs::TransformStamped> transforms = urban_nav_sim::staticTransforms(session_);
  errors_.apply(transforms);
  bag_->writeStaticTransforms(session_.begin() + number * part_, transforms);
}

void SessionBags::end() {
  bag_->commit();
  for (const auto& [topic, count] : bag_->counts()) counts_[topic] += count;
  bag_.reset();
}

void SessionBags::write(const urban_nav_sim::Measurement& measurement, StampNs taken) {
  while (part_ > 0 && taken >= session_.begin() + static_cast<StampNs>(paths_.size()) * part_) {
    end();
    begin();
  }
  for (urban_nav_sim::TopicMessage& message : messages_.convert(measurement)) {
    errors_.apply(message);
    std::visit([&](const auto& pointer) { bag_->write("/" + message.topic, taken, *pointer); }, message.message);
  }
}

void SessionBags::commit() { end(); }

std::string SessionBags::leftover() const {
  const std::string next = makePath(paths_.size());
  return part_ > 0 && std::filesystem::exists(next) ? next : "";
}

}  // namespace urban_nav
