// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/panorama_feed.hpp"

#include <algorithm>
#include <utility>

namespace urban_nav_ros {

using urban_nav_core::StampNs;

PanoramaFeed::PanoramaFeed(const Options& options)
    : options_(options),
      queue_(static_cast<int>(options.cameras), options.max_lateness, options.delivery),
      group_(options.cameras),
      missing_(options.cameras, 0) {}

void PanoramaFeed::add(std::size_t camera, RecordedImage image) {
  const StampNs stamp = image.stamp();
  image.addTo(range_);
  queue_.put(static_cast<int>(camera), stamp, std::move(image));
}

void PanoramaFeed::finish() {
  queue_.finish();
  finished_ = true;
}

bool PanoramaFeed::isComplete() const {
  return std::none_of(group_.begin(), group_.end(), [](const RecordedImage& image) { return image.empty(); });
}

Panorama PanoramaFeed::release() {
  Panorama panorama{*group_stamp_, std::exchange(group_, std::vector<RecordedImage>(options_.cameras))};
  group_stamp_.reset();
  for (std::size_t camera = 0; camera < options_.cameras; ++camera) {
    panorama.images[camera].setScale(range_.scale());
    if (panorama.images[camera].empty()) ++missing_[camera];
  }
  ++panoramas_;
  return panorama;
}

std::optional<Panorama> PanoramaFeed::take() {
  while (true) {
    if (group_stamp_ && isComplete()) return release();
    auto entry = queue_.take();
    if (!entry) return finished_ && group_stamp_ ? std::optional<Panorama>(release()) : std::nullopt;
    const auto camera = static_cast<std::size_t>(entry->stream);
    const bool fits = group_stamp_ && entry->stamp - *group_stamp_ <= options_.tolerance && group_[camera].empty();
    std::optional<Panorama> incomplete;
    if (group_stamp_ && !fits) incomplete = release();
    if (!group_stamp_) group_stamp_ = entry->stamp;
    group_[camera] = std::move(entry->item);
    if (incomplete) return incomplete;
  }
}

void PanoramaFeed::archive(urban_nav_core::Archive& archive) {
  queue_.archive(archive, [](urban_nav_core::Archive& items, RecordedImage& image) { image.archive(items); });
  for (RecordedImage& image : group_) image.archive(archive);
  archive(group_stamp_, missing_, panoramas_, finished_, range_);
  archive.require(missing_.size() == options_.cameras, "its number of cameras differs");
}

const urban_nav_core::TimeOrderedQueueCounts& PanoramaFeed::counts(std::size_t camera) const {
  return queue_.counts(static_cast<int>(camera));
}

}  // namespace urban_nav_ros
