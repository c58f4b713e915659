// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_pair_picture.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "urban_nav_core/io/image_header.hpp"

namespace urban_nav {

namespace {

constexpr int kPictureScale = 2;
constexpr int kGapPx = 4;

cv::Mat decodeJpeg(const std::string& bytes) {
  if (!urban_nav_core::imageFault(bytes).empty()) return {};
  return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_GRAYSCALE);
}

}  // namespace

std::optional<PagePicture> placePairPicture(const std::string& earlier, const std::string& query,
                                            const std::string& caption) {
  const cv::Mat above = decodeJpeg(earlier), below = decodeJpeg(query);
  if (above.empty() || below.empty()) return std::nullopt;
  const cv::Size size(kPictureScale * std::max(above.cols, below.cols),
                      kPictureScale * (above.rows + below.rows) + kGapPx);
  cv::Mat both(size, CV_8UC1, cv::Scalar(255)), scaled;
  int top = 0;
  for (const cv::Mat* image : {&above, &below}) {
    cv::resize(*image, scaled, {}, kPictureScale, kPictureScale, cv::INTER_CUBIC);
    scaled.copyTo(both({0, top, scaled.cols, scaled.rows}));
    top += scaled.rows + kGapPx;
  }
  PagePicture picture;
  cv::imencode(".jpg", both, picture.jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
  picture.width = both.cols;
  picture.height = both.rows;
  picture.caption = caption;
  return picture;
}

}  // namespace urban_nav
