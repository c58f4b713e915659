// SPDX-License-Identifier: BSD-3-Clause
#include "features/look_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

constexpr int kSaturated = 250, kBlack = 8;           // of 255, brightest channel
constexpr std::array<int, 2> kWindowRadii = {3, 10};  // px
constexpr double kLeastValidShare = 0.25;             // valid pixels of a window
constexpr int kPaperRadius = 7, kHistogramBins = 8;

/// Quantities summed over windows.
enum Channel {
  Valid,
  Light,
  LightSquare,
  Red,
  Green,
  GreenSquare,
  Blue,
  Saturation,
  Across,
  Down,
  Curvature,
  ChannelCount
};

/// Sums over rectangles of a picture's channels, weighted by the pixels' validity.
class WindowSums {
 public:
  explicit WindowSums(std::vector<cv::Mat> channels) : channels_(channels.size()) {
    urban_nav_core::forEach(channels.size(), 1, [&](std::size_t i) {
      cv::integral(channels[i], channels_[i], CV_64F);
      channels[i].release();
    });
  }
  double sum(std::size_t channel, const cv::Rect& window) const {
    const cv::Mat& all = channels_[channel];
    const double* top = all.ptr<double>(window.y);
    const double* bottom = all.ptr<double>(window.y + window.height);
    return bottom[window.x + window.width] - bottom[window.x] - top[window.x + window.width] + top[window.x];
  }

 private:
  std::vector<cv::Mat> channels_;
};

cv::Rect windowAround(const cv::Mat& image, const Eigen::Vector2f& pixel, int radius) {
  const cv::Point centre(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  return cv::Rect(centre.x - radius, centre.y - radius, 2 * radius + 1, 2 * radius + 1) &
         cv::Rect(0, 0, image.cols, image.rows);
}

bool isValid(const cv::Vec3b& colour) {
  const int brightest = std::max({colour[0], colour[1], colour[2]});
  return brightest > kBlack && brightest < kSaturated;
}

cv::Mat makeLight(const cv::Mat& image) {
  cv::Mat light(image.size(), CV_32F);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b& colour = image.at<cv::Vec3b>(y, x);
      light.at<float>(y, x) = static_cast<float>(colour[0] + colour[1] + colour[2]) / 765.0F;
    }
  return light;
}

std::vector<cv::Mat> appearanceChannels(const cv::Mat& image) {
  std::vector<cv::Mat> channels(ChannelCount);
  for (cv::Mat& channel : channels) channel = cv::Mat::zeros(image.size(), CV_32F);
  const cv::Mat light = makeLight(image);
  urban_nav_core::forEach(static_cast<std::size_t>(image.rows), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row), above = std::max(0, y - 1), below = std::min(image.rows - 1, y + 1);
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b& colour = image.at<cv::Vec3b>(y, x);
      if (!isValid(colour)) continue;
      const float l = light.at<float>(y, x), sum = 765.0F * l;
      const float highest = std::max({colour[0], colour[1], colour[2]}),
                  lowest = std::min({colour[0], colour[1], colour[2]});
      const float left = light.at<float>(y, std::max(0, x - 1)),
                  right = light.at<float>(y, std::min(image.cols - 1, x + 1));
      const float up = light.at<float>(above, x), down = light.at<float>(below, x);
      const float red = static_cast<float>(colour[2]) / sum, green = static_cast<float>(colour[1]) / sum;
      const std::array<float, ChannelCount> values = {1.0F,
                                                      l,
                                                      l * l,
                                                      red,
                                                      green,
                                                      green * green,
                                                      static_cast<float>(colour[0]) / sum,
                                                      (highest - lowest) / highest,
                                                      std::abs(right - left),
                                                      std::abs(down - up),
                                                      std::abs(left + right + up + down - 4.0F * l)};
      for (std::size_t i = 0; i < values.size(); ++i) channels[i].at<float>(y, x) = values[i];
    }
  });
  return channels;
}

/// Means over the whole image, as reference for windows, since exposure and white balance differ between images.
struct ImageMeans {
  float light = 0.0F, red = 0.0F, green = 0.0F, gradient = 0.0F;
};

float toDeviation(double square, double mean) {
  return static_cast<float>(std::sqrt(std::max(0.0, square - mean * mean)));
}

constexpr std::size_t kAppearanceValues = 13;  // per window

void writeWindow(const WindowSums& sums, const cv::Rect& window, const ImageMeans& all, float* out) {
  const double valid = sums.sum(Valid, window);
  if (valid < kLeastValidShare * window.area()) return;
  const auto mean = [&](Channel channel) { return sums.sum(static_cast<std::size_t>(channel), window) / valid; };
  const double light = mean(Light), red = mean(Red), green = mean(Green), across = mean(Across), down = mean(Down);
  out[0] = static_cast<float>(light);
  out[1] = static_cast<float>(light) / all.light;
  out[2] = static_cast<float>(red);
  out[3] = static_cast<float>(green);
  out[4] = static_cast<float>(mean(Blue));
  out[5] = static_cast<float>(red) - all.red;
  out[6] = static_cast<float>(green) - all.green;
  out[7] = static_cast<float>(mean(Saturation));
  out[8] = toDeviation(mean(LightSquare), light) / static_cast<float>(light);
  out[9] = toDeviation(mean(GreenSquare), green);
  out[10] = static_cast<float>(across / light);
  out[11] = static_cast<float>(down / light);
  out[12] = static_cast<float>(mean(Curvature) / (across + down + 1e-3));
}

ImageMeans imageMeans(const WindowSums& sums, const cv::Mat& image) {
  const cv::Rect whole(0, 0, image.cols, image.rows);
  const double valid = std::max(1.0, sums.sum(Valid, whole));
  return {static_cast<float>(std::max(1e-3, sums.sum(Light, whole) / valid)),
          static_cast<float>(sums.sum(Red, whole) / valid), static_cast<float>(sums.sum(Green, whole) / valid),
          static_cast<float>((sums.sum(Across, whole) + sums.sum(Down, whole)) / valid)};
}

/// Calls write(i, pixel) for the returns visible in the image, concurrently.
template <typename Write>
void forEachVisible(const SceneView& view, const Write& write) {
  const std::vector<std::uint8_t>& visible = view.is_visible;
  urban_nav_core::forEach(visible.size(), 2048, [&](std::size_t i) {
    if (visible[i] != 0) write(i, view.pixels[i]);
  });
}

}  // namespace

std::vector<std::string> lookFeatureNames() {
  std::vector<std::string> names;
  for (const int radius : kWindowRadii)
    for (const char* value :
         {"light", "light_relative", "red", "green", "blue", "red_relative", "green_relative", "saturation", "contrast",
          "green_deviation", "gradient_across", "gradient_down", "curvature"})
      names.push_back(std::string(value) + "_" + std::to_string(2 * radius + 1));
  return names;
}

void measureLook(const Scene& scene, std::size_t first, FeatureTable& table) {
  const cv::Mat& image = scene.view.image;
  if (image.empty()) return;
  const WindowSums sums(appearanceChannels(image));
  const ImageMeans all = imageMeans(sums, image);
  forEachVisible(scene.view, [&](std::size_t i, const Eigen::Vector2f& pixel) {
    for (std::size_t window = 0; window < kWindowRadii.size(); ++window)
      writeWindow(sums, windowAround(image, pixel, kWindowRadii[window]), all,
                  table.row(i) + first + window * kAppearanceValues);
  });
}

std::vector<std::string> paperLookNames() {
  std::vector<std::string> names;
  for (const char* channel : {"hue_", "saturation_"})
    for (int bin = 0; bin < kHistogramBins; ++bin) names.push_back(channel + std::to_string(bin));
  return names;
}

void measurePaperLook(const Scene& scene, std::size_t first, FeatureTable& table) {
  const cv::Mat& image = scene.view.image;
  if (image.empty()) return;
  cv::Mat hsv;
  cv::cvtColor(image, hsv, cv::COLOR_BGR2HSV);
  forEachVisible(scene.view, [&](std::size_t i, const Eigen::Vector2f& pixel) {
    const cv::Rect window = windowAround(image, pixel, kPaperRadius);
    std::array<float, 2 * kHistogramBins> counts{};
    float valid = 0.0F;
    for (int y = window.y; y < window.y + window.height; ++y)
      for (int x = window.x; x < window.x + window.width; ++x) {
        if (!isValid(image.at<cv::Vec3b>(y, x))) continue;
        const cv::Vec3b& pixel_hsv = hsv.at<cv::Vec3b>(y, x);
        counts[static_cast<std::size_t>(pixel_hsv[0] * kHistogramBins / 180)] += 1.0F;
        counts[static_cast<std::size_t>(kHistogramBins + pixel_hsv[1] * kHistogramBins / 256)] += 1.0F;
        valid += 1.0F;
      }
    if (valid < static_cast<float>(kLeastValidShare) * static_cast<float>(window.area())) return;
    float* out = table.row(i) + first;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) out[bin] = counts[bin] / valid;
  });
}

}  // namespace scene_labeler
