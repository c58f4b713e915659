// SPDX-License-Identifier: BSD-3-Clause
#include "device/session_frames.hpp"

#include <array>
#include <memory>
#include <variant>

#include "segway_drivers/camera/pack_frames.hpp"

namespace urban_nav {

using segway_drivers::SimCameraOptions;
using segway_drivers::SimFrame;
using urban_nav_sim::LadybugMeasurement;
using urban_nav_sim::Session;
using urban_nav_sim::StereoMeasurement;

namespace {

constexpr int kLadybugQuality = 90;

SimFrame makeFrame(segway_drivers::Bytes bytes, urban_nav_core::StampNs stamp, const Session& session) {
  return {1e-9 * static_cast<double>(stamp - session.begin()), std::move(bytes), stamp};
}

std::optional<SimFrame> nextStereo(Session& session) {
  while (const auto arrival = session.next())
    if (const auto* pair = std::get_if<StereoMeasurement>(&arrival->measurement); pair && !pair->left.empty())
      return makeFrame(segway_drivers::packBb2Frame(pair->left, pair->right), pair->stamp, session);
  return std::nullopt;
}

/// Returns the next frame of the Ladybug, assembled from the consecutive images of its five cameras.
std::optional<SimFrame> nextLadybug(Session& session) {
  std::array<cv::Mat, 5> images;
  while (const auto arrival = session.next()) {
    const auto* image = std::get_if<LadybugMeasurement>(&arrival->measurement);
    if (image == nullptr) continue;
    images[static_cast<std::size_t>(image->camera)] = image->image;
    if (image->camera + 1 == static_cast<int>(images.size()))
      return makeFrame(segway_drivers::packLadybugFrame(images, kLadybugQuality), image->stamp, session);
  }
  return std::nullopt;
}

}  // namespace

segway_drivers::FrameReader simulateFrames(urban_nav_sim::SessionOptions options, SimCameraOptions::Model model) {
  const bool is_ladybug = model == SimCameraOptions::Model::Ladybug2;
  options.sensors = {is_ladybug ? urban_nav_sim::Sensor::Ladybug : urban_nav_sim::Sensor::Stereo};
  const auto session = std::make_shared<Session>(options);
  return [session, is_ladybug] { return is_ladybug ? nextLadybug(*session) : nextStereo(*session); };
}

}  // namespace urban_nav
