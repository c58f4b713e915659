// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/pictures/match_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "pictures/canvas.hpp"
#include "urban_nav_registration/io/jpeg.hpp"

namespace urban_nav_registration {

namespace {

constexpr int kSubpixelBits = 4;  // fractional bits of OpenCV's drawing coordinates
constexpr int kUsualWidth = 512, kUsualHeight = 384;
constexpr int kLargestPicture = 16384;  // px; larger sizes are implausible
constexpr int kNarrowestView = 64;
constexpr double kOpacity = 0.5;  // opacity of the lines, so that the views remain visible
const cv::Scalar kGrey(150, 150, 150), kPanel(110, 110, 110);

/// Returns green over yellow to red, in BGR; `share`: relative to the worst.
cv::Scalar toColour(double share) {
  const double at = std::clamp(share, 0.0, 1.0);
  return at < 0.5 ? cv::Scalar(60, 200, 60 + 360 * at) : cv::Scalar(60, 200 - 280 * (at - 0.5), 240);
}

double findWorst(const MatchPictureOptions& options) {
  return options.worst_px > 0.0 ? options.worst_px : MatchPictureOptions().worst_px;
}

bool isPlausible(const Keyframe& keyframe) {
  return keyframe.width > 0 && keyframe.height > 0 && keyframe.width <= kLargestPicture &&
         keyframe.height <= kLargestPicture && keyframe.height <= 4 * keyframe.width;
}

/// Position of a view in the picture.
struct ViewPanel {
  cv::Rect area;
  double scale = 1.0;
  int width = 0, height = 0;  // size of the view

  bool shows(const Eigen::Vector2d& pixel) const {
    return pixel.allFinite() && pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < width && pixel.y() < height;
  }
  cv::Point at(const Eigen::Vector2d& pixel) const {
    constexpr double kUnit = 1 << kSubpixelBits;
    return {static_cast<int>(std::lround(kUnit * (area.x + scale * pixel.x()))),
            static_cast<int>(std::lround(kUnit * (area.y + scale * pixel.y())))};
  }
};

/// `other` provides the size of a view without one.
ViewPanel makePanel(const Keyframe& keyframe, const Keyframe& other, int widest) {
  ViewPanel result;
  const Keyframe* sized = isPlausible(keyframe) ? &keyframe : isPlausible(other) ? &other : nullptr;
  result.width = sized != nullptr ? sized->width : kUsualWidth;
  result.height = sized != nullptr ? sized->height : kUsualHeight;
  result.scale = std::min(1.0, static_cast<double>(widest) / result.width);
  result.area = {0, 0, std::max(1, static_cast<int>(std::lround(result.scale * result.width))),
                 std::max(1, static_cast<int>(std::lround(result.scale * result.height)))};
  return result;
}

void drawView(cv::Mat canvas, const Keyframe& keyframe, const std::string& title) {
  const cv::Mat picture =
      isPlausible(keyframe) ? decodeJpeg(keyframe.image, {keyframe.width, keyframe.height}) : cv::Mat();
  if (picture.empty()) {
    canvas.setTo(kPanel);
    write(canvas, keyframe.image.empty() ? "no image" : "image unreadable", {12, canvas.rows / 2}, kPaper);
  } else {
    cv::Mat reduced;
    cv::resize(picture, reduced, canvas.size(), 0.0, 0.0, cv::INTER_AREA);
    cv::cvtColor(reduced, canvas, cv::COLOR_GRAY2BGR);
  }
  writeTitle(canvas, title);
}

void drawMatchesOn(cv::Mat& canvas, const ViewPanel& a, const ViewPanel& b, const std::vector<MatchedPixels>& pixels,
                   const MatchPictureOptions& options) {
  std::vector<const MatchedPixels*> shown, others;
  for (const MatchedPixels& match : pixels)
    if (a.shows(match.in_a) && b.shows(match.in_b)) (match.inlier ? shown : others).push_back(&match);
  const double worst_px = findWorst(options);
  const auto colour = [worst_px](const MatchedPixels* match) { return toColour(match->residual_px / worst_px); };
  cv::Mat lines = canvas.clone();
  const auto draw = [&](const std::vector<const MatchedPixels*>& matches, bool is_grey) {
    // evenly spaced, so that the remaining lines are distributed as all
    const std::size_t most = static_cast<std::size_t>(std::max(options.most_lines, 1)), count = matches.size(),
                      lines_drawn = std::min(most, count);
    for (std::size_t k = 0; k < lines_drawn; ++k) {
      const MatchedPixels* match = matches[k * count / lines_drawn];
      cv::line(lines, a.at(match->in_a), b.at(match->in_b), is_grey ? kGrey : colour(match), 1, cv::LINE_AA,
               kSubpixelBits);
    }
  };
  draw(others, true);
  draw(shown, false);
  cv::addWeighted(lines, kOpacity, canvas, 1.0 - kOpacity, 0.0, canvas);
  for (const MatchedPixels* match : shown)
    for (const cv::Point& end : {a.at(match->in_a), b.at(match->in_b)})
      cv::circle(canvas, end, 2 << kSubpixelBits, colour(match), cv::FILLED, cv::LINE_AA, kSubpixelBits);
}

void drawStrip(cv::Mat canvas, const MatchPictureOptions& options) {
  constexpr int kBar = 60, kWords = 100;
  write(canvas, options.caption, {6, 16}, kInk);
  const int from = canvas.cols - kBar - kWords;
  if (from < kNarrowestView) return;
  cv::rectangle(canvas, {from - 60, 0, canvas.cols - from + 60, canvas.rows}, kPaper, cv::FILLED);
  write(canvas, "residual", {from - 58, 16}, kInk);
  for (int i = 0; i < kBar; ++i)
    cv::line(canvas, {from + 4 + i, 7}, {from + 4 + i, 17}, toColour(static_cast<double>(i) / (kBar - 1)));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g px", findWorst(options));
  write(canvas, text.data(), {from + kBar + 10, 16}, kInk);
}

}  // namespace

Picture drawMatches(const Keyframe& a, const Keyframe& b, const std::vector<MatchedPixels>& pixels,
                    const MatchPictureOptions& options) {
  const int widest = std::clamp(options.widest, kNarrowestView, kLargestPicture);
  ViewPanel of_a = makePanel(a, b, widest), of_b = makePanel(b, a, widest);
  if (options.stacked) of_b.area.y = of_a.area.height + kPanelGap;
  else of_b.area.x = of_a.area.width + kPanelGap;
  const cv::Rect both = of_a.area | of_b.area;
  cv::Mat canvas(both.height + kCaptionHeight, both.width, CV_8UC3, kPaper);
  drawView(canvas(of_a.area), a, options.title_a);
  drawView(canvas(of_b.area), b, options.title_b);
  cv::Mat views = canvas(both);
  drawMatchesOn(views, of_a, of_b, pixels, options);
  drawStrip(canvas(cv::Rect(0, both.height, both.width, kCaptionHeight)), options);
  return toPicture(canvas);
}

}  // namespace urban_nav_registration
