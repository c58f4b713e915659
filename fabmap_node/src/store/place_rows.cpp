// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/store/place_rows.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "fabmap_node/model/word_bytes.hpp"
#include "fabmap_node/recognition/compact_look.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::DataError;
using urban_nav_core::ImageView;
using urban_nav_store::StoredPlace;

namespace {

constexpr int kThumbnailHeight = 64;             // px
constexpr int kThumbnailQuality = 60;            // of JPEG
constexpr std::size_t kLargestThumbnail = 6000;  // bytes

std::optional<ObservationStatus> parseStatus(const std::string& word) {
  for (const ObservationStatus status :
       {ObservationStatus::Used, ObservationStatus::NoImage, ObservationStatus::Dark, ObservationStatus::Blank,
        ObservationStatus::Blurred, ObservationStatus::TooFewFeatures})
    if (word == toString(status)) return status;
  return std::nullopt;
}

cv::Mat toMatrix(const ImageView& image) {
  auto* pixels = const_cast<std::uint8_t*>(image.data);  // cv::Mat has no const view; it is only read
  return {image.height, image.width, CV_8UC1, pixels, static_cast<std::size_t>(image.stride)};
}

}  // namespace

StoredPlace toStoredPlace(const urban_nav_store::SessionId& session, urban_nav_core::StampNs stamp,
                          const PlaceDescription& description, const std::string& model) {
  StoredPlace row;
  row.session = session;
  row.stamp = stamp;
  row.cameras = description.cameras;
  row.missing = description.missing;
  row.status = toString(description.status);
  row.model = model;
  const std::vector<std::uint8_t> words = packWords(description.words);
  row.words.assign(words.begin(), words.end());
  row.descriptors = description.look;
  return row;
}

PlaceDescription toPlaceDescription(const StoredPlace& row, std::size_t vocabulary_size) {
  const std::string name = "place of session " + row.session + " at " + urban_nav_core::printStamp(row.stamp) + " s";
  PlaceDescription description;
  const std::optional<ObservationStatus> status = parseStatus(row.status);
  const auto words = unpackWords({row.words.begin(), row.words.end()}, vocabulary_size);
  if (!status || !words || row.cameras < 1 || row.cameras > 255 || row.missing < 0 || row.missing > row.cameras)
    throw DataError(name, "is damaged, or has words of another vocabulary", "");
  description.status = *status;
  description.cameras = static_cast<std::uint8_t>(row.cameras);
  description.missing = static_cast<std::uint8_t>(row.missing);
  description.words = *words;
  description.look = row.descriptors;
  if (description.status == ObservationStatus::Used) checkLook(description.look, name);
  return description;
}

std::string placeThumbnail(const std::vector<ImageView>& images) {
  std::vector<cv::Mat> small;
  for (const ImageView& image : images) {
    if (image.empty()) continue;
    const int width = std::max(
        1, static_cast<int>(std::lround(image.width * (static_cast<double>(kThumbnailHeight) / image.height))));
    cv::resize(toMatrix(image), small.emplace_back(), {width, kThumbnailHeight}, 0.0, 0.0, cv::INTER_AREA);
  }
  if (small.empty()) return {};
  cv::Mat strip;
  cv::hconcat(small, strip);
  std::vector<std::uint8_t> bytes;
  for (int quality = kThumbnailQuality; quality >= 10; quality /= 2) {
    cv::imencode(".jpg", strip, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    if (bytes.size() <= kLargestThumbnail) return {bytes.begin(), bytes.end()};
  }
  return {};
}

}  // namespace fabmap_node
