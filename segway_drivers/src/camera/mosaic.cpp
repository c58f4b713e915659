// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/mosaic.hpp"

#include <array>
#include <opencv2/imgproc.hpp>

namespace segway_drivers {

std::optional<MosaicPattern> parseMosaicPattern(const std::string& text) {
  if (text == "YYYY") return MosaicPattern::None;
  if (text == "RGGB") return MosaicPattern::Rggb;
  if (text == "GBRG") return MosaicPattern::Gbrg;
  if (text == "GRBG") return MosaicPattern::Grbg;
  if (text == "BGGR") return MosaicPattern::Bggr;
  return std::nullopt;
}

cv::Mat demosaic(const cv::Mat& mosaic, MosaicPattern pattern) {
  // OpenCV names a pattern by the second and third pixel of the second row.
  int code = 0;
  switch (pattern) {
    case MosaicPattern::None: return mosaic;
    case MosaicPattern::Rggb: code = cv::COLOR_BayerBG2BGR; break;
    case MosaicPattern::Gbrg: code = cv::COLOR_BayerGR2BGR; break;
    case MosaicPattern::Grbg: code = cv::COLOR_BayerGB2BGR; break;
    case MosaicPattern::Bggr: code = cv::COLOR_BayerRG2BGR; break;
  }
  cv::Mat image;
  cv::cvtColor(mosaic, image, code);
  return image;
}

const char* mosaicEncoding(MosaicPattern pattern) {
  switch (pattern) {
    case MosaicPattern::None: return "mono8";
    case MosaicPattern::Rggb: return "bayer_rggb8";
    case MosaicPattern::Gbrg: return "bayer_gbrg8";
    case MosaicPattern::Grbg: return "bayer_grbg8";
    case MosaicPattern::Bggr: return "bayer_bggr8";
  }
  return "mono8";
}

cv::Mat combinePlanes(const cv::Mat planes[4], MosaicPattern pattern) {
  struct Places {
    std::size_t red, green_a, green_b, blue;
  };
  const std::array<Places, 5> places = {Places{0, 0, 0, 0}, {0, 1, 2, 3}, {2, 0, 3, 1}, {1, 0, 3, 2}, {3, 1, 2, 0}};
  const Places& place = places[static_cast<std::size_t>(pattern)];
  if (pattern == MosaicPattern::None) return planes[0];
  cv::Mat green, image;
  cv::addWeighted(planes[place.green_a], 0.5, planes[place.green_b], 0.5, 0.0, green);
  cv::merge(std::vector<cv::Mat>{planes[place.blue], green, planes[place.red]}, image);
  return image;
}

}  // namespace segway_drivers
