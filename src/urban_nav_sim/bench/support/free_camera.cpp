// SPDX-License-Identifier: BSD-3-Clause
#include "free_camera.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "camera/render.hpp"

namespace urban_nav_sim::bench {
namespace {

constexpr int kPixelSamples = 3;
constexpr float kMiddle = 0.145F;  // target mean of the lower two thirds, linear

/// Filmic curve (Narkowicz 2015), then the gamma of screens.
float toned(float light) {
  const float x = std::max(light, 0.0F);
  const float pressed = x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F);
  return 255.0F * std::pow(std::clamp(pressed, 0.0F, 1.0F), 1.0F / 2.2F);
}

}  // namespace

urban_nav_core::Pose FreeCamera::place() const {
  const Eigen::Vector3d z = (to - from).normalized(), x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  urban_nav_core::Matrix3d R;
  R << x, z.cross(x), z;
  return {R, from};
}

Lens FreeCamera::lens(int finer) const {
  const double focal = 0.5 * finer * width / std::tan(0.5 * field);
  return {finer * width, finer * height, focal, focal, 0.5 * (finer * width - 1), 0.5 * (finer * height - 1), {}};
}

cv::Mat photograph(const Tracer& tracer, const Sky& sky, const FreeCamera& camera, double t) {
  Picture picture;
  render(Snapshot(tracer, t, t), sky, RayTable(camera.lens(kPixelSamples)), camera.place(), Colours::Rgb, picture);
  const cv::Mat fine(picture.height, picture.width, CV_32FC3, picture.radiance.data());
  cv::Mat light, image(camera.height, camera.width, CV_8UC3);
  cv::resize(cv::min(fine, 4.0), light, image.size(), 0.0, 0.0, cv::INTER_AREA);  // limits the spread of the solar disc

  const Eigen::Vector3f day = sky.day().sun + sky.day().sky,
                        balance = Eigen::Vector3f::Constant(day.y()).cwiseQuotient(day);
  const cv::Scalar mean = cv::mean(light.rowRange(camera.height / 3, camera.height));
  const float exposure = kMiddle / static_cast<float>(std::max((mean[0] + mean[1] + mean[2]) / 3.0, 1e-6));
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto& rgb = light.at<cv::Vec3f>(v, u);
      for (int i = 0; i < 3; ++i)
        image.at<cv::Vec3b>(v, u)[2 - i] = cv::saturate_cast<std::uint8_t>(toned(exposure * balance[i] * rgb[i]));
    }
  }
  return image;
}

}  // namespace urban_nav_sim::bench
