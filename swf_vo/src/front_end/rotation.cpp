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

constexpr int kMostRotationSteps = 10;
constexpr double kFarTurn = 0.07;      // rad: 4 deg
constexpr double kSettled = 1e-4;      // rad
constexpr double kLongestStep = 0.05;  // rad
constexpr int kWantedPixels = 1500;    // target number of pixels in the sums
constexpr int kLeastKnown = 20;        // landmarks required to use only their surroundings
constexpr double kImprovement = 0.98;

using Vector5 = Eigen::Matrix<float, 5, 1>;
using Matrix5 = Eigen::Matrix<float, 5, 5>;

}  // namespace

struct RotationTracker::Normal {
  Matrix5 H = Matrix5::Zero();  // rotation, gain, offset
  Vector5 b = Vector5::Zero();
  float squares = 0.0F;
  int count = 0;

  /// Root mean square residual with optimal gain and offset.
  double rms() const {
    if (count < 100) return -1.0;
    const Eigen::Vector2f light = H.bottomRightCorner<2, 2>().ldlt().solve(b.tail<2>());
    return std::sqrt(std::max(0.0F, squares - light.dot(b.tail<2>())) / static_cast<float>(count));
  }
};

void RotationTracker::fill(const ImageView& image, Plane& plane) {
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

void RotationTracker::choose(int level, const std::vector<Parallax>& known) {
  samples_.clear();
  const double scale = 1.0 / static_cast<double>(1 << level);
  const auto add = [&](int u, int v, const Vector3d& shift) {
    if (u < 2 || v < 2 || u >= last_.width - 2 || v >= last_.height - 2) return;
    Sample sample;
    sample.at = static_cast<std::size_t>(v) * static_cast<std::size_t>(last_.width) + static_cast<std::size_t>(u);
    sample.ray = camera_.ray({u / scale, v / scale}).cast<float>();
    sample.shift = shift.cast<float>();
    samples_.push_back(sample);
  };
  const int count = static_cast<int>(known.size());
  if (count >= kLeastKnown) {
    const int skip = 1 + 9 * count / kWantedPixels;
    for (int i = 0; i < count; i += skip) {
      const Parallax& k = known[static_cast<std::size_t>(i)];
      const int u = static_cast<int>(std::lround(k.pixel.x() * scale)),
                v = static_cast<int>(std::lround(k.pixel.y() * scale));
      for (int dv = -2; dv <= 2; dv += 2)
        for (int du = -2; du <= 2; du += 2) add(u + du, v + dv, k.shift);
    }
    return;
  }
  const int step =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(last_.width) * last_.height / kWantedPixels)));
  for (int v = 2; v + 2 < last_.height; v += step)
    for (int u = 2; u + 2 < last_.width; u += step) add(u, v, Vector3d::Zero());
}

RotationTracker::Normal RotationTracker::sum(int level, const Matrix3d& R) const {
  const double scale = 1.0 / static_cast<double>(1 << level);
  const float fx = static_cast<float>(camera_.fx * scale), fy = static_cast<float>(camera_.fy * scale);
  const float cx = static_cast<float>(camera_.cx * scale), cy = static_cast<float>(camera_.cy * scale);
  const float right = static_cast<float>(now_.width - 2), bottom = static_cast<float>(now_.height - 2);
  const std::size_t w = static_cast<std::size_t>(now_.width);
  const Eigen::Matrix3f r = R.cast<float>();
  Normal n;
  for (const Sample& sample : samples_) {
    const Eigen::Vector3f turned = r * sample.ray, p = turned + sample.shift;
    if (!(p.z() > 0.1F)) continue;
    const float iz = 1.0F / p.z(), x = p.x() * iz, y = p.y() * iz;
    const float un = fx * x + cx, vn = fy * y + cy;
    if (!(un >= 1.0F && vn >= 1.0F && un < right && vn < bottom)) continue;
    const int iu = static_cast<int>(un), iv = static_cast<int>(vn);
    const float a = un - static_cast<float>(iu), b = vn - static_cast<float>(iv);
    const std::size_t i = static_cast<std::size_t>(iv) * w + static_cast<std::size_t>(iu);
    const auto at = [&](const std::vector<float>& m) {
      return (1.0F - b) * ((1.0F - a) * m[i] + a * m[i + 1]) + b * ((1.0F - a) * m[i + w] + a * m[i + w + 1]);
    };
    // ESM: mean of both gradients, for second-order convergence
    const float gu = 0.5F * (at(now_.du) + last_.du[sample.at]) * fx * iz,
                gv = 0.5F * (at(now_.dv) + last_.dv[sample.at]) * fy * iz;
    const float gz = gu * x + gv * y;
    // e = now(R ray + shift) - last(ray) = J d + gain last + offset, with d the error of the rotation
    Vector5 J;
    J << -(gv * turned.z() + gz * turned.y()), gu * turned.z() + gz * turned.x(), gv * turned.x() - gu * turned.y(),
        last_.grey[sample.at] - 128.0F, 1.0F;
    J.head<3>() = -J.head<3>();
    const float e = at(now_.grey) - last_.grey[sample.at];
    n.H.noalias() += J * J.transpose();
    n.b += J * e;
    n.squares += e * e;
    ++n.count;
  }
  return n;
}

RotationTracker::Descent RotationTracker::descend(int level, const Quaterniond& start) const {
  Quaterniond q = start;
  Normal normal = sum(level, q.toRotationMatrix());
  Descent descent{start, normal.rms(), normal.rms()};
  if (descent.before < 0.0) return descent;
  for (int i = 0; i < kMostRotationSteps; ++i) {
    normal.H.diagonal().array() += 1e-3F;
    Vector3d d = normal.H.ldlt().solve(normal.b).head<3>().cast<double>();
    if (!d.allFinite()) break;
    if (d.norm() > kLongestStep) d *= kLongestStep / d.norm();
    q = (expSo3(d) * q).normalized();
    if (d.norm() < kSettled) break;
    normal = sum(level, q.toRotationMatrix());
    const double rms = normal.rms();
    if (rms < 0.0) break;
    if (rms < descent.after) {
      descent.after = rms;
      descent.q = q;
    }
  }
  return descent;
}

RotationEstimate RotationTracker::track(const ImageView& image, int level, const Quaterniond& start,
                                        const std::vector<Parallax>& known) {
  RotationEstimate estimate;
  estimate.q_now_last = start;
  std::swap(last_, now_);
  fill(image, now_);
  if (last_.width != now_.width || last_.height != now_.height) return estimate;

  choose(level, known);
  Descent descent = descend(level, start);
  estimate.before = descent.before;
  if (descent.before < 0.0) return estimate;
  // The rotation of a shaken camera may reverse, contrary to the prediction.
  if (start.angularDistance(Quaterniond::Identity()) > kFarTurn) {
    const Descent back = descend(level, Quaterniond::Identity());
    if (back.before >= 0.0 && back.after < descent.after) descent = back;
  }
  const double best = descent.after;
  estimate.q_now_last = descent.q;
  estimate.after = best;
  estimate.found = best < kImprovement * estimate.before;
  if (!estimate.found) estimate.q_now_last = start;
  return estimate;
}

void RotationTracker::archive(urban_nav_core::Archive& archive) {
  // Grey levels are integers, and gradients are recomputed from them.
  std::vector<std::uint8_t> grey(now_.grey.begin(), now_.grey.end());
  archive(now_.width, now_.height, grey);
  if (!archive.isReading()) return;
  constexpr int kLargest = 1 << 14;  // px
  archive.require(now_.width >= 0 && now_.height >= 0 && now_.width < kLargest && now_.height < kLargest &&
                      grey.size() == static_cast<std::size_t>(now_.width) * static_cast<std::size_t>(now_.height),
                  "invalid image size");
  fill({grey.data(), now_.width, now_.height, now_.width}, now_);
}

}  // namespace swf_vo
