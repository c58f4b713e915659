// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/confusion_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace urban_nav {

namespace {

constexpr int kLongestSide = 1000;  // px
constexpr double kAnnouncedAbove = 0.99;
const cv::Vec3b kSamePlace(255, 226, 204), kRightMatch(62, 138, 43), kWrongMatch(40, 40, 214);
constexpr double kFaintest = 0.01;  // probability drawn as white

/// An image with a square per pair of rows: several px each for few rows, several rows per px otherwise.
class MatrixCanvas {
 public:
  explicit MatrixCanvas(std::size_t rows)
      : rows_per_px_(std::max(1, (static_cast<int>(rows) + kLongestSide - 1) / kLongestSide)),
        px_per_row_(std::max(1, kLongestSide / std::max(1, static_cast<int>(rows)))) {
    const int side = std::max(1, (static_cast<int>(rows) + rows_per_px_ - 1) / rows_per_px_ * px_per_row_);
    pixels_ = cv::Mat(side, side, CV_8UC3, cv::Scalar(255, 255, 255));
  }
  /// Draws `colour` if it is darker in one of its channels.
  void darken(std::size_t row, std::size_t place, const cv::Vec3b& colour) {
    cv::Mat square = pixels_(at(row, place));
    cv::min(square, cv::Scalar(colour[0], colour[1], colour[2]), square);
  }
  void set(std::size_t row, std::size_t place, const cv::Vec3b& colour, int least_px) {
    cv::Rect square = at(row, place);
    const int grow = std::max(0, least_px - square.width) / 2;
    square = cv::Rect(square.x - grow, square.y - grow, square.width + 2 * grow, square.height + 2 * grow) &
             cv::Rect(0, 0, pixels_.cols, pixels_.rows);
    pixels_(square).setTo(cv::Scalar(colour[0], colour[1], colour[2]));
  }
  const cv::Mat& pixels() const { return pixels_; }

 private:
  cv::Rect at(std::size_t row, std::size_t place) const {
    const auto offset = [&](std::size_t i) { return static_cast<int>(i) / rows_per_px_ * px_per_row_; };
    return {offset(place), offset(row), px_per_row_, px_per_row_};
  }

  int rows_per_px_, px_per_row_;
  cv::Mat pixels_;
};

bool areSamePlace(const PlaceTruth& truth, std::size_t a, std::size_t b) {
  return judgeMatch(truth, {a, b, 0.0}) == MatchTruth::Right;
}

cv::Mat drawConfusion(const PlaceEvaluation& evaluation) {
  const std::size_t rows = evaluation.query.rows.size();
  MatrixCanvas canvas(rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t place = 0; place < row; ++place) {
      const PlaceQueryRow &query = evaluation.query.rows[row], &earlier = evaluation.query.rows[place];
      const bool is_masked = query.session == earlier.session && earlier.stamp > query.stamp - evaluation.mask;
      if (!is_masked && areSamePlace(evaluation.truth, row, place)) canvas.darken(row, place, kSamePlace);
    }
  for (const WordProbability& entry : evaluation.confusion) {
    if (entry.place_row < 0) continue;
    const double share = std::clamp(1.0 - std::log(entry.probability) / std::log(kFaintest), 0.0, 1.0);
    const auto grey = static_cast<unsigned char>(std::lround(235.0 * (1.0 - share)));
    canvas.darken(entry.row, static_cast<std::size_t>(entry.place_row), {grey, grey, grey});
  }
  for (const RankedMatch& match : rankedMatches(evaluation.query)) {
    const auto verdict = judgeMatch(evaluation.truth, match);
    if (!verdict || match.score <= kAnnouncedAbove || *verdict == MatchTruth::Neither) continue;
    canvas.set(match.row, match.matched_row, *verdict == MatchTruth::Right ? kRightMatch : kWrongMatch, 4);
  }
  return canvas.pixels();
}

std::vector<unsigned char> encode(const cv::Mat& pixels, const char* extension) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, pixels, bytes);
  return bytes;
}

}  // namespace

std::string confusionPng(const PlaceEvaluation& evaluation) {
  const std::vector<unsigned char> bytes = encode(drawConfusion(evaluation), ".png");
  return {bytes.begin(), bytes.end()};
}

PagePicture confusionPagePicture(const PlaceEvaluation& evaluation) {
  const cv::Mat pixels = drawConfusion(evaluation);
  PagePicture picture;
  picture.jpeg = encode(pixels, ".jpg");
  picture.width = pixels.cols;
  picture.height = pixels.rows;
  picture.caption =
      "Confusion matrix: images from top to bottom, earlier images from left to right. Grey: probability by words "
      "alone; blue: the same place in truth; green and red: announced above 0.99, right and wrong.";
  return picture;
}

}  // namespace urban_nav
