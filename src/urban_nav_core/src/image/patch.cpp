// SPDX-License-Identifier: BSD-3-Clause
#include "patch_kernel.hpp"
#include "patch_read.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

namespace urban_nav_core {

using namespace patch_kernel;

namespace {

using cv::v_float32x4;

constexpr double kWindowSigma = 3.0;  // px
constexpr int kPhases = 256;          // of the spline's table: at most 1/512 px from the exact phase
constexpr double kOwnBlur =
    1.0 / 3.0 + 0.25;  // px^2, variance of the spline and of a usual lens (0.5 px), along each axis
constexpr double kLeastBlurTap = 0.01, kLargestBlurTap = 0.33;  // px^2, variance of the spline and of a typical lens
                                                                // (0.5 px), along each axis
constexpr double kMinScale = 0.4, kMaxScale = 2.5;
constexpr int kMaxIterations = 12;
constexpr double kSettledStep = 0.003;  // px

std::array<float, 4> spline(double f) {
  const double g = 1.0 - f;
  return {static_cast<float>(g * g * g / 6.0), static_cast<float>((3.0 * f * f * f - 6.0 * f * f + 4.0) / 6.0),
          static_cast<float>((3.0 * g * g * g - 6.0 * g * g + 4.0) / 6.0), static_cast<float>(f * f * f / 6.0)};
}

struct SplineTable {
  alignas(16) std::array<std::array<float, 4>, kPhases + 1> weights;
  SplineTable() {
    for (int i = 0; i <= kPhases; ++i) weights[static_cast<std::size_t>(i)] = spline(static_cast<double>(i) / kPhases);
  }
};
const SplineTable& splineTable() {
  static const SplineTable table;
  return table;
}

double sum(const v_float32x4& a) { return static_cast<double>(cv::v_reduce_sum(a)); }

constexpr std::size_t kTaps = patch_read::kTaps;

/// Returns the spline's weights at a phase, convolved with (blur, 1 - 2 blur, blur).
std::array<float, kTaps> blurredSpline(double f, double blur) {
  const std::array<float, 4> w = spline(f);
  const float side = static_cast<float>(blur), middle = static_cast<float>(1.0 - 2.0 * blur);
  std::array<float, kTaps> made{};
  for (std::size_t i = 0; i < 4; ++i) {
    made[i] += side * w[i];
    made[i + 1] += middle * w[i];
    made[i + 2] += side * w[i];
  }
  return made;
}

constexpr int kWideSize = kPatchSize + 4, kWideStride = 16;  // margins of one pixel for the gradient and one for the
                                                             // blur
using WideGrid = std::array<float, kWideSize * kWideStride>;

/// Weights sixteen taps at once: pixels about (u, v) by the table rows of two phases.
v_float32x4 weighed(const float* p, const float* wx, const float* wy) {
  constexpr int kStride = PatchSource::kStride;
  const v_float32x4 y = cv::v_load_aligned(wy);
  const v_float32x4 column = cv::v_broadcast_element<0>(y) * cv::v_load(p) +
                             cv::v_broadcast_element<1>(y) * cv::v_load(p + kStride) +
                             (cv::v_broadcast_element<2>(y) * cv::v_load(p + 2 * kStride) +
                              cv::v_broadcast_element<3>(y) * cv::v_load(p + 3 * kStride));
  return column * cv::v_load_aligned(wx);
}

/// Warps the source into the view, with a margin of `margin` (1 or 2) pixels around the window.
void warpWide(const PatchSource& source, const PatchWarp& warp, int margin, WideGrid& out) {
  using cv::v_int32x4;
  constexpr int kStride = PatchSource::kStride;
  static_assert(kStride == 24, "24 = 16 + 8, below");
  alignas(16) std::array<float, PatchSource::kSize * kStride> pixels;
  for (std::size_t i = 0; i < pixels.size(); i += 4)
    cv::v_store_aligned(&pixels[i], cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(&source.pixels[i]))));
  const auto& table = splineTable().weights;
  // p = back q / (1 - bend . back q)
  const Eigen::Matrix2d source_from_view = warp.A.inverse();
  const v_float32x4 ax = cv::v_setall_f32(static_cast<float>(source_from_view(0, 0))),
                    ay = cv::v_setall_f32(static_cast<float>(source_from_view(1, 0)));
  const float bx = static_cast<float>(source_from_view(0, 1)), by = static_cast<float>(source_from_view(1, 1));
  const v_float32x4 low = cv::v_setall_f32(1.0F), high = cv::v_setall_f32(PatchSource::kSize - 2.01F),
                    lines = cv::v_setall_f32(kPhases), half = cv::v_setall_f32(0.5F);
  const v_float32x4 middle = cv::v_setall_f32(PatchSource::kRadius), step(0.0F, 1.0F, 2.0F, 3.0F);
  const v_float32x4 one = cv::v_setall_f32(1.0F), bend_x = cv::v_setall_f32(static_cast<float>(warp.bend.x())),
                    bend_y = cv::v_setall_f32(static_cast<float>(warp.bend.y()));
  for (int j = 2 - margin; j < kWideSize - 2 + margin; ++j) {
    const float dv = static_cast<float>(j - kPatchRadius - 2);
    const v_float32x4 x0 = cv::v_setall_f32(bx * dv), y0 = cv::v_setall_f32(by * dv);
    for (int i = 0; i < kWideSize; i += 4) {
      const v_float32x4 du = step + cv::v_setall_f32(static_cast<float>(i - kPatchRadius - 2));
      const v_float32x4 qx = x0 + ax * du, qy = y0 + ay * du, depth = one / (one - bend_x * qx - bend_y * qy);
      const v_float32x4 x = cv::v_min(cv::v_max(middle + qx * depth, low), high),
                        y = cv::v_min(cv::v_max(middle + qy * depth, low), high);
      const v_int32x4 u = cv::v_trunc(x), v = cv::v_trunc(y);
      alignas(16) int place[4], phase_x[4], phase_y[4];
      cv::v_store_aligned(place, (v << 4) + (v << 3) + u);
      cv::v_store_aligned(phase_x, cv::v_trunc((x - cv::v_cvt_f32(u)) * lines + half));
      cv::v_store_aligned(phase_y, cv::v_trunc((y - cv::v_cvt_f32(v)) * lines + half));
      v_float32x4 part[4], across[4];
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k)
        part[k] = weighed(&pixels[static_cast<std::size_t>(place[k] - kStride - 1)],
                          table[static_cast<std::size_t>(phase_x[k])].data(),
                          table[static_cast<std::size_t>(phase_y[k])].data());
      cv::v_transpose4x4(part[0], part[1], part[2], part[3], across[0], across[1], across[2], across[3]);
      cv::v_store(&out[static_cast<std::size_t>(j * kWideStride + i)],
                  (across[0] + across[1]) + (across[2] + across[3]));
    }
  }
}

/// Convolves with (blur, 1 - 2 blur, blur) along rows (step 1) or columns (step kWideStride), except at the border.
void blurWide(double blur, std::size_t step, WideGrid& grid) {
  const float side = static_cast<float>(blur), middle = static_cast<float>(1.0 - 2.0 * blur);
  const WideGrid before = grid;
  const v_float32x4 side4 = cv::v_setall_f32(side), middle4 = cv::v_setall_f32(middle);
  std::size_t at = step;
  for (; at + step + 4 <= grid.size(); at += 4)
    cv::v_store(&grid[at], side4 * (cv::v_load(&before[at - step]) + cv::v_load(&before[at + step])) +
                               middle4 * cv::v_load(&before[at]));
  for (; at + step < grid.size(); ++at) grid[at] = side * (before[at - step] + before[at + step]) + middle * before[at];
}

constexpr int kSpreadRows = kPatchSize + 2, kSpreadStride = 24, kSpreadMargin = 4;
using SpreadGrid = std::array<float, kSpreadRows * kSpreadStride>;

/// Convolves a filter with (1 4 1)/6 along columns and pads it with zeros left and right. All stores precede the loads
/// along rows, because a load that overlaps two pending stores stalls.
void spreadAlongColumns(const PatchGrid& filter, SpreadGrid& out) {
  static constexpr float kZeros[kPatchStride] = {};
  const auto row = [&](int j) {
    return j < 0 || j >= kPatchSize ? kZeros : &filter[static_cast<std::size_t>(j * kPatchStride)];
  };
  const v_float32x4 side = cv::v_setall_f32(1.0F / 6.0F), middle = cv::v_setall_f32(4.0F / 6.0F);
  for (int j = 0; j < kSpreadRows; ++j) {
    const float *above = row(j - 2), *here = row(j - 1), *below = row(j);
    float* to = &out[static_cast<std::size_t>(j * kSpreadStride)];
    cv::v_store(to, cv::v_setzero_f32());
#pragma GCC unroll 3
    for (int i = 0; i < kPatchStride; i += 4)
      cv::v_store(to + kSpreadMargin + i,
                  side * (cv::v_load(above + i) + cv::v_load(below + i)) + middle * cv::v_load(here + i));
    cv::v_store(to + kSpreadMargin + kPatchStride, cv::v_setzero_f32());
    cv::v_store(to + kSpreadMargin + kPatchStride + 4, cv::v_setzero_f32());
  }
}

/// Returns the covariance of two filter responses to the smoothed image, for white noise of one grey level in the
/// image.
Eigen::Matrix2d noiseThroughSpline(const PatchGrid& fx, const PatchGrid& fy) {
  SpreadGrid x, y;
  spreadAlongColumns(fx, x);
  spreadAlongColumns(fy, y);
  const v_float32x4 side = cv::v_setall_f32(1.0F / 6.0F), middle = cv::v_setall_f32(4.0F / 6.0F);
  v_float32x4 xx = cv::v_setzero_f32(), xy = xx, yy = xx;
  for (std::size_t j = 0; j < x.size(); j += kSpreadStride)
#pragma GCC unroll 4
    for (std::size_t i = j; i < j + 16; i += 4) {  // from two columns left of the filter to two right of it
      const v_float32x4 a = side * (cv::v_load(&x[i + 1]) + cv::v_load(&x[i + 3])) + middle * cv::v_load(&x[i + 2]);
      const v_float32x4 b = side * (cv::v_load(&y[i + 1]) + cv::v_load(&y[i + 3])) + middle * cv::v_load(&y[i + 2]);
      xx += a * a;
      xy += a * b;
      yy += b * b;
    }
  Eigen::Matrix2d made;
  made << sum(xx), sum(xy), sum(xy), sum(yy);
  return made;
}

/// Extracts value and central differences from the wide grid.
void split(const WideGrid& wide, PatchTemplate& made, Gradients& gradients) {
  const v_float32x4 half = cv::v_setall_f32(0.5F);
  for (int j = 0; j < kPatchSize; ++j)
    for (int i = 0; i < 12; i += 4) {
      const float* p = &wide[static_cast<std::size_t>((j + 2) * kWideStride + i + 2)];
      const std::size_t at = static_cast<std::size_t>(j * kPatchStride + i);
      cv::v_store(&made.value[at], cv::v_load(p));
      cv::v_store(&gradients.x[at], half * (cv::v_load(p + 1) - cv::v_load(p - 1)));
      cv::v_store(&gradients.y[at], half * (cv::v_load(p + kWideStride) - cv::v_load(p - kWideStride)));
    }
}

}  // namespace

namespace patch_kernel {

Window::Window() {
  for (int v = 0; v < kPatchSize; ++v)
    for (int u = 0; u < kPatchSize; ++u) {
      const double r2 = std::pow(u - kPatchRadius, 2) + std::pow(v - kPatchRadius, 2);
      const float w = static_cast<float>(std::exp(-r2 / (2.0 * kWindowSigma * kWindowSigma)));
      weight[static_cast<std::size_t>(v * kPatchStride + u)] = w;
      total += static_cast<double>(w);
    }
}

const Window& window() {
  static const Window made;
  return made;
}

double dot(const PatchGrid& a, const PatchGrid& b) {
  v_float32x4 total[3] = {cv::v_setzero_f32(), cv::v_setzero_f32(), cv::v_setzero_f32()};
  for (std::size_t i = 0; i < a.size(); i += kPatchStride)
#pragma GCC unroll 3
    for (std::size_t k = 0; k < 3; ++k) total[k] += cv::v_load(&a[i + 4 * k]) * cv::v_load(&b[i + 4 * k]);
  return sum(total[0] + total[1] + total[2]);
}

bool fits(const ImageView& image, double x, double y) {
  return x >= kPatchRadius + 2 && y >= kPatchRadius + 2 && x < image.width - kPatchRadius - 3 &&
         y < image.height - kPatchRadius - 3;
}

void readWindow(const ImageView& image, double x, double y, const Eigen::Vector2d& blur, PatchGrid& out) {
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const std::array<float, kTaps> wx = blurredSpline(x - u, blur.x()), wy = blurredSpline(y - v, blur.y());
  const bool blurs = blur.maxCoeff() > 0.0;  // otherwise the outer weights are zero
  patch_read::fastest().read(image.row(v - kPatchRadius - 2) + u - kPatchRadius - 2, image.stride, wx.data(), wy.data(),
                             blurs, out.data());
}

void makeBlind(const PatchGrid& gradient, const PatchTemplate& patch, PatchGrid& out) {
  const Window& w = window();
  const double mean = dot(patch.value, w.weight) / w.total;
  const double along_offset = dot(gradient, w.weight) / w.total;
  const double along_gain = dot(gradient, patch.filter_gain) / (patch.energy * w.total);
  const v_float32x4 offset = cv::v_setall_f32(static_cast<float>(along_offset - along_gain * mean));
  const v_float32x4 gain = cv::v_setall_f32(static_cast<float>(along_gain));
  for (std::size_t i = 0; i < out.size(); i += 4)
    cv::v_store(&out[i],
                cv::v_load(&w.weight[i]) * (cv::v_load(&gradient[i]) - offset - gain * cv::v_load(&patch.value[i])));
}

bool makeTemplate(const PatchSource& source, const PatchWarp& warp, PatchTemplate& made, Gradients& gradients) {
  const Eigen::Matrix2d& A = warp.A;
  const double scale2 = std::abs(A.determinant());
  if (!(scale2 > kMinScale * kMinScale && scale2 < kMaxScale * kMaxScale) || !(warp.bend.norm() <= kLargestBend))
    return false;
  WideGrid wide{};
  // An enlarged template is more blurred than the view, a reduced one less. Unequal blur shifts the position of a
  // corner.
  const Eigen::Vector2d excess = 0.5 * kOwnBlur * ((A * A.transpose()).diagonal().array() - 1.0).matrix();
  const Eigen::Vector2d own = (-excess).cwiseMax(0.0).cwiseMin(kLargestBlurTap);
  made.view_blur = (excess.array() > kLeastBlurTap).select(excess.array().min(kLargestBlurTap), 0.0).matrix();
  const bool blurs = own.maxCoeff() > kLeastBlurTap;
  warpWide(source, warp, blurs ? 2 : 1, wide);
  if (own.x() > kLeastBlurTap) blurWide(own.x(), 1, wide);
  if (own.y() > kLeastBlurTap) blurWide(own.y(), kWideStride, wide);
  split(wide, made, gradients);
  made.warp = warp;
  const Window& w = window();
  const double mean = dot(made.value, w.weight) / w.total;
  const v_float32x4 mean4 = cv::v_setall_f32(static_cast<float>(mean));
  for (std::size_t i = 0; i < made.value.size(); i += 4)
    cv::v_store(&made.filter_gain[i], cv::v_load(&w.weight[i]) * (cv::v_load(&made.value[i]) - mean4));
  const double energy_sum = dot(made.filter_gain, made.value);
  made.energy = energy_sum / w.total;
  if (!(made.energy > 1.0)) return false;
  makeBlind(gradients.x, made, made.filter_x);
  makeBlind(gradients.y, made, made.filter_y);
  Eigen::Matrix2d hessian;
  const double cross = dot(made.filter_x, gradients.y);
  hessian << dot(made.filter_x, gradients.x), cross, cross, dot(made.filter_y, gradients.y);
  const double trace = hessian.trace(), det = hessian.determinant();
  if (!(trace > 0.0) || !(det > 1e-4 * trace * trace) || !(trace > w.total)) return false;
  made.inverse_hessian = hessian.inverse();
  made.unit_covariance = made.inverse_hessian * noiseThroughSpline(made.filter_x, made.filter_y) * made.inverse_hessian;
  return true;
}

Reading measure(const PatchGrid& pixels, const PatchTemplate& patch) {
  const Window& w = window();
  const patch_read::Sums sums = patch_read::fastest().measure(pixels.data(), w.weight.data(), patch.filter_x.data(),
                                                              patch.filter_y.data(), patch.filter_gain.data());
  Reading r;
  r.along = {static_cast<double>(sums.along_x), static_cast<double>(sums.along_y)};
  r.mean = static_cast<double>(sums.mean) / w.total;
  r.variance = std::max(static_cast<double>(sums.square) / w.total - r.mean * r.mean, 0.0);
  r.gain = static_cast<double>(sums.gain) / (patch.energy * w.total);
  return r;
}

}  // namespace patch_kernel

namespace {

double computeCorrelation(const Reading& reading, const PatchTemplate& patch) {
  return reading.gain * std::sqrt(patch.energy / std::max(reading.variance, 1e-9));
}

/// Computes pixel noise, correlation and covariance from the residual at the minimum.
void judge(const Reading& reading, const PatchTemplate& patch, Alignment& alignment) {
  const double g = reading.gain, explained = g * g * patch.energy;
  alignment.gain = g;
  alignment.correlation = computeCorrelation(reading, patch);
  // 4 of about 57 / 2 independent weighted values determine position, offset and gain
  const double residual = std::max(reading.variance - explained, 0.0) * 1.15;
  // (b, 1 - 2 b, b) leaves 1 - 4 b + 6 b^2 of the variance of white noise; of smoothed noise about the square root
  const auto left = [](double tap) { return std::sqrt(1.0 - 4.0 * tap + 6.0 * tap * tap); };
  const double view_noise = kSmoothedNoise * std::sqrt(left(patch.view_blur.x()) * left(patch.view_blur.y()));
  const double noise2 = residual / (view_noise + g * g * kSmoothedNoise);
  alignment.noise = std::sqrt(noise2);
  alignment.covariance =
      patch.unit_covariance * (std::max(noise2, 1.0 / 12.0) / (g * g));  // at least the rounding error of grey levels
}

}  // namespace

std::optional<PatchSource> cutSource(const ImageView& image, int u, int v) {
  constexpr int kMargin = kPatchRadius + 3;
  if (image.empty() || u < kMargin || v < kMargin || u >= image.width - kMargin || v >= image.height - kMargin)
    return std::nullopt;
  PatchSource source;
  const int first = u - PatchSource::kRadius;
  const bool inside = first >= 0 && first + PatchSource::kSize <= image.width;
  for (int j = 0; j < PatchSource::kSize; ++j) {
    const std::uint8_t* row = image.row(std::clamp(v - PatchSource::kRadius + j, 0, image.height - 1));
    if (inside) {
      std::memcpy(&source.pixels[static_cast<std::size_t>(j * PatchSource::kStride)], row + first, PatchSource::kSize);
      continue;
    }
    for (int i = 0; i < PatchSource::kSize; ++i)
      source.pixels[static_cast<std::size_t>(j * PatchSource::kStride + i)] =
          row[std::clamp(u - PatchSource::kRadius + i, 0, image.width - 1)];
  }
  return source;
}

bool warpTemplate(const PatchSource& source, const PatchWarp& warp, PatchTemplate& made) {
  Gradients gradients;
  return makeTemplate(source, warp, made, gradients);
}

Alignment alignPatch(const ImageView& image, const PatchTemplate& patch, const Eigen::Vector2d& start, double reach) {
  Alignment alignment;
  alignment.position = start;
  PatchGrid pixels;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!start.allFinite() || !fits(image, alignment.position.x(), alignment.position.y())) return alignment;
    readWindow(image, alignment.position.x(), alignment.position.y(), patch.view_blur, pixels);
    const Reading reading = measure(pixels, patch);
    if (!(reading.gain > 0.05)) return alignment;
    Eigen::Vector2d step = patch.inverse_hessian * reading.along / reading.gain;
    const double length = step.norm();
    if (length > 1.0) step /= length;
    if (length < kSettledStep) {
      judge(reading, patch, alignment);
      alignment.position -= step;
      alignment.converged = true;
      return alignment;
    }
    alignment.position -= step;
    if ((alignment.position - start).norm() > reach) return alignment;
  }
  return alignment;
}

double correlationAt(const ImageView& image, const PatchTemplate& patch, const Eigen::Vector2d& at) {
  if (!at.allFinite() || !fits(image, at.x(), at.y())) return 0.0;
  PatchGrid pixels;
  readWindow(image, at.x(), at.y(), patch.view_blur, pixels);
  return std::clamp(computeCorrelation(measure(pixels, patch), patch), -1.0, 1.0);
}

}  // namespace urban_nav_core
