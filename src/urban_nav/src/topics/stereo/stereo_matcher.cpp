// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/stereo_matcher.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "base/plot.hpp"
#include "dense_stereo_paper/paper_matcher.hpp"
#include "topics/stereo/depth_view_row.hpp"
#include "topics/stereo/disparity_picture.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_registration/pictures/picture.hpp"

namespace urban_nav {

using dense_stereo::GroundPlane;
using dense_stereo::NearScene;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_store::GroundView;
using urban_nav_store::NearPoints;

namespace {

constexpr int kPanelWidth = 400;  // px

/// Returns the z axis of base_link in the left optical frame; nullopt for an upright camera, assumed if the mounting is
/// unknown.
std::optional<Eigen::Vector3d> expectedUp(const Pose& T_base_camera) {
  const Eigen::Vector3d up = T_base_camera.R().transpose() * Eigen::Vector3d::UnitZ();
  if ((up + Eigen::Vector3d::UnitY()).norm() < 1e-6) return std::nullopt;
  return up;
}

double largestDeviation(const Eigen::Matrix3d& covariance) {
  const auto values = urban_nav_core::symmetricEigenvalues(covariance);
  return values ? std::sqrt(std::max(0.0, values->maxCoeff())) : 0.0;
}

GroundView viewOfGround(const GroundPlane& ground, const Pose& T_base_camera) {
  GroundView view;
  view.verdict = toString(ground.verdict);
  view.up = T_base_camera.R() * ground.up;
  view.height = ground.height - view.up.dot(T_base_camera.t());
  view.sigma = largestDeviation(ground.covariance.topLeftCorner<3, 3>());
  view.support = ground.support;
  return view;
}

NearPoints nearPoints(const NearScene& scene, const urban_nav_core::ImageView& left, const StereoCamera& camera,
                      const Pose& T_base_camera, double spacing) {
  NearPoints row;
  row.camera = T_base_camera.t();
  row.pixel_angle = 1.0 / camera.left.fx;
  std::vector<NearPoints::Point> points;
  for (const dense_stereo::DensePoint& point : thinPoints(scene.points, spacing)) {
    const Eigen::Vector3d p = point.p_cam.cast<double>();
    const double sigma =
        std::sqrt(static_cast<double>(point.variance)) * p.norm() / static_cast<double>(point.disparity);
    points.push_back({(T_base_camera * p).cast<float>(), static_cast<float>(sigma), left.at(point.u, point.v)});
  }
  row.packed = NearPoints::pack(points);
  return row;
}

/// Draws left image, disparities, deviations and ground in four panels.
StereoPicture drawPanels(const NearScene& scene, const urban_nav_core::ImageView& left, const StereoCamera& camera) {
  const cv::Mat grey(left.height, left.width, CV_8UC1, const_cast<std::uint8_t*>(left.data),
                     static_cast<std::size_t>(left.stride));
  cv::Mat first;
  cv::cvtColor(grey, first, cv::COLOR_GRAY2BGR);
  const std::array<cv::Mat, 4> panels = {first, drawDisparities(scene.stereo.image), drawDeviations(scene.stereo.image),
                                         drawGround(scene, left, camera)};
  const int height = std::max(1, kPanelWidth * left.height / std::max(1, left.width));
  urban_nav_registration::Picture picture{2 * kPanelWidth, 2 * height, {}};
  picture.bgr.resize(static_cast<std::size_t>(6 * kPanelWidth * 2 * height));
  cv::Mat all(2 * height, 2 * kPanelWidth, CV_8UC3, picture.bgr.data());
  for (int i = 0; i < 4; ++i) {
    cv::Mat panel = all(cv::Rect(i % 2 * kPanelWidth, i / 2 * height, kPanelWidth, height));
    cv::resize(panels[static_cast<std::size_t>(i)], panel, panel.size(), 0, 0,
               i == 0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  }
  StereoPicture made;
  made.jpeg = encodeJpeg(picture, 80);
  made.width = picture.width;
  made.height = picture.height;
  return made;
}

/// Returns whether a planar laser maps surfaces around the robot. A horizontal one measures one height alone.
bool hasTiltedLaser(const urban_nav_input::SourceInfo& info) {
  return std::any_of(info.lasers.begin(), info.lasers.end(), [](const urban_nav_input::LaserInfo& laser) {
    return !urban_nav_core::isHorizontal(laser.T_base_laser);
  });
}

std::string describeKeyframe(const StereoKeyframe& keyframe) {
  std::string text = urban_nav_core::formatNumber(100.0 * keyframe.answered, 3) + " % of the pixels matched, " +
                     urban_nav_core::formatNumber(100.0 * keyframe.near_share, 3) + " % of these near; ";
  if (keyframe.hasGround())
    text += "camera " + urban_nav_core::formatNumber(keyframe.height, 3) + " m above the ground";
  else text += "ground: " + keyframe.ground;
  if (!keyframe.sentence.empty()) text += "; " + keyframe.sentence;
  return text;
}

}  // namespace

struct StereoMatcher::Setting {
  StereoCamera camera;
  Pose T_base_camera;
  std::optional<Eigen::Vector3d> up;
  std::string session;
  double point_spacing = 0.1;
  bool has_lasers = false;  // planar ones that the motion moves through space

  StereoOutput match(dense_stereo::NearSceneEstimator& estimator, const urban_nav_core::StereoPair& pair,
                     bool with_picture) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const NearScene& scene = estimator.process(pair, up);
    StereoOutput made;
    StereoKeyframe& keyframe = made.keyframe;
    keyframe.ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    made.ground = viewOfGround(scene.ground, T_base_camera);
    made.ground.session = session;
    made.ground.stamp = keyframe.stamp = pair.stamp;
    if (has_lasers) {
      made.points = nearPoints(scene, pair.left, camera, T_base_camera, point_spacing);
      made.points->session = session;
      made.points->stamp = pair.stamp;
    } else if (scene.stereo.answered > 0.0) {
      made.view = depthViewRow(scene.stereo.image, pair.left, camera, T_base_camera);
      made.view->session = session;
      made.view->stamp = pair.stamp;
    }
    keyframe.reason = toString(static_cast<dense_stereo::Reason>(scene.stereo.status.reason));
    keyframe.sentence = scene.stereo.status.sentence;
    keyframe.answered = scene.stereo.answered;
    keyframe.near_share = scene.near_share;
    keyframe.ground = made.ground.verdict;
    keyframe.tilt = std::acos(std::clamp(made.ground.up.z(), -1.0, 1.0));
    keyframe.height = scene.ground.height;
    keyframe.points = static_cast<std::int64_t>(scene.points.size());
    keyframe.obstacles = static_cast<std::int64_t>(scene.obstacles.size());
    if (with_picture) {
      made.picture = drawPanels(scene, pair.left, camera);
      made.picture->caption = describeKeyframe(keyframe);
    }
    return made;
  }
};

StereoMatcher::StereoMatcher(const dense_stereo::Parameters& parameters, const urban_nav_input::SourceInfo& info,
                             const std::string& session, bool one_thread)
    : setting_(std::make_shared<Setting>(Setting{info.camera, info.T_base_camera, expectedUp(info.T_base_camera),
                                                 session, parameters.point_spacing, hasTiltedLaser(info)})),
      launch_(one_thread ? std::launch::deferred : std::launch::async) {
  for (auto& estimator : estimators_)
    estimator = std::make_shared<dense_stereo::NearSceneEstimator>(parameters, info.camera,
                                                                   dense_stereo::makePaperMatcher(parameters));
}

std::optional<StereoOutput> StereoMatcher::add(const urban_nav_core::StereoPairWithMotion& frame, std::int64_t number,
                                               bool with_picture) {
  std::optional<StereoOutput> done;
  if (pending_.size() == kWorkers) done = next();  // its estimator is free from then on
  // The owners keep the pixels alive.
  pending_.push_back(
      std::async(launch_, [setting = setting_, estimator = estimators_[added_++ % kWorkers], pair = frame.pair,
                           left = frame.left_owner, right = frame.right_owner, number, with_picture] {
        StereoOutput made = setting->match(*estimator, pair, with_picture);
        if (made.picture) made.picture->keyframe = number;
        return made;
      }));
  return done;
}

std::optional<StereoOutput> StereoMatcher::next() {
  if (pending_.empty()) return std::nullopt;
  StereoOutput first = pending_.front().get();
  pending_.pop_front();
  return first;
}

}  // namespace urban_nav
