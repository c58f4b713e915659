// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/keyframe_writer.hpp"

#include <algorithm>

#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace urban_nav {

using urban_nav_store::StoredKeyframe;

namespace {

constexpr std::size_t kMaxPending = 2;

}  // namespace

KeyframeWriter::KeyframeWriter(const urban_nav_registration::Parameters& parameters,
                               const urban_nav_core::StereoCamera& camera, bool one_thread)
    : selector_(parameters),
      extractor_(std::make_shared<urban_nav_registration::KeyframeExtractor>(camera, parameters.points)),
      launch_(one_thread ? std::launch::deferred : std::launch::async) {}

void KeyframeWriter::resume(const SessionOdometry& run, const std::vector<urban_nav_core::StampNs>& stored) {
  for (const OdometryFrame& row : run.frames)
    if (std::binary_search(stored.begin(), stored.end(), row.stamp)) selector_.keep(row.T_odom_base);
}

std::optional<StoredKeyframe> KeyframeWriter::process(const urban_nav_core::StereoPairWithMotion& frame,
                                                      const OdometryFrame& row) {
  if (!row.accepted || frame.pair.left.empty() || frame.pair.right.empty()) return std::nullopt;
  if (!selector_.select(row.T_odom_base)) return std::nullopt;
  std::optional<StoredKeyframe> done;
  if (made_.size() == kMaxPending) done = next();
  // the owners keep the pixels alive
  made_.push_back(std::async(launch_, [extractor = extractor_, pair = frame.pair, left = frame.left_owner,
                                       right = frame.right_owner, stamp = row.stamp] {
    return urban_nav_registration::toStoredKeyframe(extractor->extract({"", stamp}, pair));
  }));
  return done;
}

std::optional<StoredKeyframe> KeyframeWriter::next() {
  if (made_.empty()) return std::nullopt;
  StoredKeyframe first = made_.front().get();
  made_.pop_front();
  return first;
}

}  // namespace urban_nav
