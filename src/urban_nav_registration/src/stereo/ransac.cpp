// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/ransac.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace urban_nav_registration {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

constexpr double kCornerPx = 1.0;     // px of its level: repeatability of corners
constexpr double kDisparityPx = 0.3;  // px, added to the standard deviation: the two corners are not exactly the same
                                      // point
constexpr double kGate = 16.3;        // chi-square, 3 degrees of freedom, 99.9 %
constexpr double kConfidence = 0.999;
constexpr int kLeastSamples = 60, kMostSamples = 1500;
constexpr int kFewestInliers = 8;        // inliers: three fit by definition, and a few more by chance
constexpr double kLeastZ = 1.0 / 200.0;  // 1/m: minimum inverse depth of the points of a triple

struct Item {
  PointMeasurement measurement;
  Eigen::Vector3d p_a, p_b;  // in units of their depths: not used for far points
  bool deep = false;         // depth is significant in both views
  double rho = 0.0, sigma_rho = 0.0, sigma_px = 1.0;
};

std::vector<Item> makeItems(const StereoCamera& camera, const View& a, const View& b,
                            const std::vector<DescriptorMatch>& pairs) {
  std::vector<Item> items;
  items.reserve(pairs.size());
  const double per_depth = camera.left.fx * camera.baseline;
  for (const DescriptorMatch& pair : pairs) {
    const ViewPoint &in_a = a.points[static_cast<std::size_t>(pair.a)],
                    &in_b = b.points[static_cast<std::size_t>(pair.b)];
    Item item;
    PointMeasurement& measurement = item.measurement;
    measurement.point = pair.a;
    measurement.ray = in_a.ray;
    measurement.disparity = in_a.disparity;
    measurement.sigma_disparity = std::hypot(in_a.sigma_disparity, kDisparityPx);
    measurement.pixel = in_b.pixel;
    item.sigma_px = kCornerPx * std::max(in_a.size(), in_b.size());
    measurement.covariance = item.sigma_px * item.sigma_px * Eigen::Matrix2d::Identity();
    measurement.other_disparity = in_b.disparity;
    measurement.other_sigma = std::hypot(in_b.sigma_disparity, kDisparityPx);
    item.rho = inverseDepth(measurement, camera);
    item.sigma_rho = measurement.sigma_disparity / per_depth;
    const double rho_b = (in_b.disparity - camera.disparity_offset) / per_depth;
    item.deep = item.rho > kLeastZ && rho_b > kLeastZ;
    if (item.deep) {
      item.p_a = in_a.ray / item.rho;
      item.p_b = in_b.ray / rho_b;
    }
    items.push_back(item);
  }
  return items;
}

/// Returns the chi-square of a pair with three degrees of freedom, limited to the gate.
double misfit(const Item& item, const StereoCamera& camera, const Eigen::Matrix3d& R_b_a,
              const Eigen::Vector3d& t_b_a) {
  const auto& c = camera.left;
  const Eigen::Vector3d p = R_b_a * item.measurement.ray + t_b_a * item.rho;
  if (!(p.z() > 1e-3)) return kGate;
  const double iz = 1.0 / p.z(), x = p.x() * iz, y = p.y() * iz, per_depth = c.fx * camera.baseline;
  const double by_px = 1.0 / item.sigma_px, by_disparity = 1.0 / item.measurement.other_sigma;
  const Eigen::Vector3d e(
      (item.measurement.pixel.x() - c.fx * x - c.cx) * by_px, (item.measurement.pixel.y() - c.fy * y - c.cy) * by_px,
      (item.measurement.other_disparity - camera.disparity_offset - per_depth * item.rho * iz) * by_disparity);
  const double square = e.squaredNorm();
  if (square > 1e4 * kGate) return kGate;
  const Eigen::Vector3d j =
      item.sigma_rho * Eigen::Vector3d(c.fx * iz * (t_b_a.x() - x * t_b_a.z()) * by_px,
                                       c.fy * iz * (t_b_a.y() - y * t_b_a.z()) * by_px,
                                       per_depth * iz * (1.0 - item.rho * iz * t_b_a.z()) * by_disparity);
  const double along = j.dot(e);
  return std::min(kGate, square - along * along / (1.0 + j.squaredNorm()));
}

struct Score {
  double cost = 0.0;
  int inliers = 0;
};

Score computeScore(const std::vector<Item>& items, const StereoCamera& camera, const Pose& T_a_b) {
  const Pose T_b_a = T_a_b.inverse();
  const Eigen::Matrix3d R = T_b_a.R();
  Score score;
  for (const Item& item : items) {
    const double chi2 = misfit(item, camera, R, T_b_a.t());
    score.cost += chi2;
    if (chi2 < kGate) ++score.inliers;
  }
  return score;
}

/// Returns the axes of a triangle: along its first side, in its plane, normal to it. Empty if the points are collinear
/// or coincide.
std::optional<Eigen::Matrix3d> findAxes(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
  const Eigen::Vector3d x = q - p, n = x.cross(r - p);
  if (!(n.norm() > 0.02 * x.norm() * (r - p).norm()) || !(x.norm() > 0.05)) return std::nullopt;
  Eigen::Matrix3d axes;
  axes.col(0) = x.normalized();
  axes.col(2) = n.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

std::optional<Pose> throughTriple(const std::array<const Item*, 3>& triple, const StereoCamera& camera) {
  const auto a = findAxes(triple[0]->p_a, triple[1]->p_a, triple[2]->p_a);
  const auto b = findAxes(triple[0]->p_b, triple[1]->p_b, triple[2]->p_b);
  if (!a || !b) return std::nullopt;
  const Eigen::Matrix3d R = *a * b->transpose();
  Eigen::Vector3d middle_a = Eigen::Vector3d::Zero(), middle_b = Eigen::Vector3d::Zero();
  std::vector<PointMeasurement> measurements;
  for (const Item* item : triple) {
    middle_a += item->p_a / 3.0;
    middle_b += item->p_b / 3.0;
    measurements.push_back(item->measurement);
  }
  if (!R.allFinite()) return std::nullopt;
  EstimateOptions options;
  options.steps = 3;
  options.sigma_offset = 0.0;
  options.scaled = false;
  const Estimate refined = estimate(camera, measurements, Pose(R, middle_a - R * middle_b), options);
  if (!refined.T_a_b.isFinite()) return std::nullopt;
  return refined.T_a_b;
}

/// Repeats the estimation from all inliers until their number does not increase.
Pose improve(const std::vector<Item>& items, const StereoCamera& camera, Pose T_a_b, Score& score) {
  for (int round = 0; round < 3; ++round) {
    const Pose T_b_a = T_a_b.inverse();
    const Eigen::Matrix3d R = T_b_a.R();
    std::vector<PointMeasurement> measurements;
    for (const Item& item : items)
      if (misfit(item, camera, R, T_b_a.t()) < kGate) measurements.push_back(item.measurement);
    if (measurements.size() < 3) break;
    EstimateOptions options;
    options.steps = 4;
    options.sigma_offset = 0.0;
    options.scaled = false;
    const Pose better = estimate(camera, measurements, T_a_b, options).T_a_b;
    if (!better.isFinite()) break;
    const Score its = computeScore(items, camera, better);
    if (its.cost >= score.cost) break;
    score = its;
    T_a_b = better;
  }
  return T_a_b;
}

int samplesFor(int inliers, std::size_t count) {
  const double share = static_cast<double>(inliers) / static_cast<double>(count), all = share * share * share;
  if (all >= 1.0) return kLeastSamples;
  const double samples = std::log(1.0 - kConfidence) / std::log(1.0 - std::max(all, 1e-9));
  return static_cast<int>(
      std::clamp(std::ceil(samples), static_cast<double>(kLeastSamples), static_cast<double>(kMostSamples)));
}

}  // namespace

Consensus findConsensus(const StereoCamera& camera, const View& a, const View& b,
                        const std::vector<DescriptorMatch>& pairs) {
  Consensus result;
  const std::vector<Item> items = makeItems(camera, a, b, pairs);
  std::vector<const Item*> deep;
  for (const Item& item : items)
    if (item.deep) deep.push_back(&item);
  if (deep.size() < 3) return result;
  Score best{kGate * static_cast<double>(items.size()), 0};
  std::uint32_t state = 12345;
  int wanted = kMostSamples;
  const auto count = static_cast<std::uint32_t>(deep.size());
  for (; result.samples < wanted; ++result.samples) {
    std::array<const Item*, 3> triple{};
    for (auto next = triple.begin(); next != triple.end();) {
      state = state * 1664525U + 1013904223U;
      *next = deep[(state >> 8) % count];
      if (std::find(triple.begin(), next, *next) == next) ++next;
    }
    const auto T_a_b = throughTriple(triple, camera);
    if (!T_a_b) continue;
    Score score = computeScore(items, camera, *T_a_b);
    if (score.cost >= best.cost) continue;
    result.T_a_b = improve(items, camera, *T_a_b, score);
    best = score;
    wanted = samplesFor(best.inliers, items.size());
  }
  result.inliers = best.inliers;
  result.found = best.inliers >= kFewestInliers;
  const Pose T_b_a = result.T_a_b.inverse();
  const Eigen::Matrix3d R = T_b_a.R();
  for (std::size_t i = 0; i < items.size(); ++i)
    if (misfit(items[i], camera, R, T_b_a.t()) >= kGate) result.others.push_back(pairs[i]);
  return result;
}

}  // namespace urban_nav_registration
