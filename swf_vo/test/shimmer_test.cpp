// SPDX-License-Identifier: BSD-3-Clause
// Shimmering images, as above a hot road: displacements of a fifth of a pixel, different in each frame and without
// effect on patch residuals. The filter must estimate the noise from the residuals of the window.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "recordings.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::StereoPair;
using urban_nav_core::testing::namedMotion;
using urban_nav_core::testing::RenderedSequence;
using urban_nav_core::testing::SequenceOptions;
using urban_nav_core::testing::texturedRoom;

constexpr int kShimmerFrames = 60, kCell = 12;  // px
constexpr double kAmplitude = 0.2;              // px, standard deviation

/// A field of displacements with a correlation length of a patch.
void shimmer(const ImageView& image, cv::RNG& random, cv::Mat& moved) {
  const cv::Mat whole(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                      static_cast<std::size_t>(image.stride));
  cv::Mat coarse(image.height / kCell + 1, image.width / kCell + 1, CV_32FC2), field;
  random.fill(coarse, cv::RNG::NORMAL, 0.0, kAmplitude);
  cv::resize(coarse, field, whole.size(), 0, 0, cv::INTER_CUBIC);
  for (int v = 0; v < field.rows; ++v)
    for (int u = 0; u < field.cols; ++u)
      field.at<cv::Vec2f>(v, u) += cv::Vec2f(static_cast<float>(u), static_cast<float>(v));
  cv::remap(whole, moved, field, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
}

TEST(Shimmer, IsInTheCovariance) {
  double nees = 0.0;
  constexpr int kRooms = 2;
  for (int room = 1; room <= kRooms; ++room) {
    const auto seed = static_cast<std::uint32_t>(room);
    const auto motion = namedMotion("wander", "room", seed);
    SequenceOptions options;
    options.camera = roomCamera();
    options.seed = seed;
    RenderedSequence sequence(texturedRoom({}, seed), motion, options);
    SwfVo filter(Parameters(), stereoCamera(), Pose());
    cv::RNG random(seed);
    cv::Mat left, right;
    double sum = 0.0;
    for (int i = 0; i < kShimmerFrames; ++i) {
      const StereoPair pair = sequence.frame(i).pair();
      shimmer(pair.left, random, left);
      shimmer(pair.right, random, right);
      const auto view = [](const cv::Mat& image) {
        return ImageView{image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
      };
      const Frame& frame = filter.process({pair.stamp, view(left), view(right)});
      expectProper(frame);
      if (i < 20) continue;
      sum += urban_nav_core::nees(motion(0.0).inverse() * motion(sequence.time(i)), frame.T_odom_base).value_or(1e9);
    }
    nees += sum / (kShimmerFrames - 20) / kRooms;
  }
  EXPECT_LT(nees, 10.0) << "6 were right";
}

}  // namespace
}  // namespace swf_vo
