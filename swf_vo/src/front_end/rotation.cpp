// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/rotation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace swf_vo {

using urban_nav_core::expSo3;
using urban_nav_core::ImageView;
using urban_nav_core::Matrix3d;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

namespace {

constexpr int most_steps = 10;
constexpr double settled = 1e-4;      // rad
constexpr double longest_step = 0.05; // rad
constexpr int wanted_pixels = 1500;   // of which the sums are made
constexpr double improvement = 0.98;

using Vector5 = Eigen::Matrix<float, 5, 1>;
using Matrix5 = Eigen::Matrix<float, 5, 5>;

}  // namespace

struct RotationTracker::Normal {
  Matrix5 H = Matrix5::Zero();   // rotation, gain, offset
  Vector5 b = Vector5::Zero();
  float squares = 0.0F;
  int count = 0;

  /// Residual left when gain and offset are at their best, root mean square.
  double rms() const {
    if (count < 100) return -1.0;
    const Eigen::Vector2f light = H.bottomRightCorner<2, 2>().ldlt().solve(b.tail<2>());
    return std::sqrt(std::max(0.0F, squares - light.dot(b.tail<2>())) / static_cast<float>(count));
  }
};

void RotationTracker::fill(const ImageView& image, Plane& plane) const {
  plane.width = image.width;
  plane.height = image.height;
  const std::size_t size = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  plane.grey.resize(size);
  plane.du.assign(size, 0.0F);
  plane.dv.assign(size, 0.0F);
  for (int v = 0; v < image.height; ++v) {
    const std::uint8_t* row = image.row(v);
    for (int u = 0; u < image.width; ++u) plane.grey[static_cast<std::size_t>(v * image.width + u)] = row[u];
  }
  for (int v = 1; v + 1 < image.height; ++v)
    for (int u = 1; u + 1 < image.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * image.width + u), w = static_cast<std::size_t>(image.width);
      plane.du[i] = 0.5F * (plane.grey[i + 1] - plane.grey[i - 1]);
      plane.dv[i] = 0.5F * (plane.grey[i + w] - plane.grey[i - w]);
    }
}

RotationTracker::Normal RotationTracker::sum(const Plane& last, const Plane& now, int level, const Matrix3d& R) const {
  const double scale = 1.0 / static_cast<double>(1 << level);
  const float fx = static_cast<float>(camera_.fx * scale), fy = static_cast<float>(camera_.fy * scale);
  const float cx = static_cast<float>(camera_.cx * scale), cy = static_cast<float>(camera_.cy * scale);
  const Eigen::Matrix3f r = R.cast<float>();
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(last.width) * last.height / wanted_pixels)));
  Normal n;
  for (int v = 2; v + 2 < last.height; v += step)
    for (int u = 2; u + 2 < last.width; u += step) {
      const Eigen::Vector3f p = r * Eigen::Vector3f((static_cast<float>(u) - cx) / fx, (static_cast<float>(v) - cy) / fy, 1.0F);
      if (!(p.z() > 0.1F)) continue;
      const float x = p.x() / p.z(), y = p.y() / p.z();
      const float un = fx * x + cx, vn = fy * y + cy;
      if (!(un >= 1.0F && vn >= 1.0F && un < static_cast<float>(now.width - 2) && vn < static_cast<float>(now.height - 2))) continue;
      const int iu = static_cast<int>(un), iv = static_cast<int>(vn);
      const float a = un - static_cast<float>(iu), b = vn - static_cast<float>(iv);
      const std::size_t i = static_cast<std::size_t>(iv * now.width + iu), w = static_cast<std::size_t>(now.width);
      const auto at = [&](const std::vector<float>& m) {
        return (1.0F - b) * ((1.0F - a) * m[i] + a * m[i + 1]) + b * ((1.0F - a) * m[i + w] + a * m[i + w + 1]);
      };
      const std::size_t j = static_cast<std::size_t>(v * last.width + u);
      // ESM: the mean of both gradients, which makes the step second order
      const float gu = 0.5F * (at(now.du) + last.du[j]) * fx, gv = 0.5F * (at(now.dv) + last.dv[j]) * fy;
      Vector5 J;
      J << -gu * x * y - gv * (1.0F + y * y), gu * (1.0F + x * x) + gv * x * y, -gu * y + gv * x, last.grey[j] - 128.0F, 1.0F;
      const float e = at(now.grey) - last.grey[j];
      // e = what the rotation still to come would take away: now(R p) - last(p) = -J_rotation d + gain last + offset
      J.head<3>() = -J.head<3>();
      n.H.noalias() += J * J.transpose();
      n.b += J * e;
      n.squares += e * e;
      ++n.count;
    }
  return n;
}

RotationEstimate RotationTracker::track(const ImageView& image, int level, const Quaterniond& start) {
  RotationEstimate estimate;
  estimate.q_now_last = start;
  std::swap(last_, now_);
  fill(image, now_);
  if (last_.width != now_.width || last_.height != now_.height) return estimate;

  Quaterniond q = start;
  Normal normal = sum(last_, now_, level, q.toRotationMatrix());
  estimate.before = normal.rms();
  double best = estimate.before;
  if (best < 0.0) return estimate;
  for (int i = 0; i < most_steps; ++i) {
    normal.H.diagonal().array() += 1e-3F;
    Vector3d d = normal.H.ldlt().solve(normal.b).head<3>().cast<double>();
    if (!d.allFinite()) break;
    if (d.norm() > longest_step) d *= longest_step / d.norm();
    q = (expSo3(d) * q).normalized();
    if (d.norm() < settled) break;
    normal = sum(last_, now_, level, q.toRotationMatrix());
    const double rms = normal.rms();
    if (rms < 0.0) break;
    if (rms < best) {
      best = rms;
      estimate.q_now_last = q;
    }
  }
  estimate.after = best;
  estimate.found = best < improvement * estimate.before;
  if (!estimate.found) estimate.q_now_last = start;
  return estimate;
}

}  // namespace swf_vo
