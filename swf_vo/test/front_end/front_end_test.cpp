// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/front_end.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "rendered.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::angleBetween;
using urban_nav_core::distanceBetween;
using urban_nav_core::expSe3;
using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::StereoPair;
using urban_nav_core::Vector6d;
using namespace urban_nav_core::testing;

/// Drives a front end with exact poses and landmarks triangulated from their first observation, without a window.
class Bench {
 public:
  explicit Bench(const StereoCamera& camera) : camera_(camera), front_end_(Parameters(), camera) { map_.reserve(4000); }

  const FrontEndResult& see(const StereoPair& pair, const Pose& last, const Pose& predicted) {
    map_.clear();
    for (const auto& [id, p] : landmarks_) map_.push_back({id, p});
    return front_end_.process(frame_++, pair, last, predicted, map_, 0.0);
  }

  void learn(const FrontEndResult& seen, const Pose& T_odom_camera) {
    for (const LandmarkId id : seen.ended) landmarks_.erase(id);
    for (const LandmarkId id : seen.refuted) landmarks_.erase(id);
    for (const Observation& o : seen.fresh) {
      EXPECT_TRUE(ids_.insert(o.landmark).second) << "id used twice";
      const double disparity = std::max(o.z.x() - o.z.z(), 1e-3), w = disparity / (camera_.left.fx * camera_.baseline);
      const Eigen::Vector3d p = T_odom_camera.q() * camera_.left.ray(o.z.head<2>()) + T_odom_camera.t() * w;
      landmarks_[o.landmark] << p, w;
    }
  }

  const std::map<LandmarkId, Eigen::Vector4d>& landmarks() const { return landmarks_; }

 private:
  StereoCamera camera_;
  FrontEnd front_end_;
  FrameId frame_ = 0;
  std::map<LandmarkId, Eigen::Vector4d> landmarks_;
  std::set<LandmarkId> ids_;
  std::vector<MapPoint> map_;
};

Pose off(const Pose& T, double metres, double radians) {
  Vector6d d;
  d << metres, -metres, metres, radians, -radians, 0.0;
  return T * expSe3(d);
}

RenderedSequence room(double rate) {
  SequenceOptions options = smallCamera(2.0);
  options.rate = rate;
  return {texturedRoom(), wander({0.0, 0.0, 1.2}, {1.0, 0.6, 0.2}, 0.5, 0.05, 3), options};
}

TEST(FrontEnd, FollowsLandmarksThroughARoom) {
  RenderedSequence sequence = room(20.0);
  const StereoCamera camera = makeCamera(sequence.options().camera);
  Bench bench(camera);
  Pose last = sequence.T_world_camera(0);
  for (int i = 0; i < 12; ++i) {
    const Pose truth = sequence.T_world_camera(i);
    const FrontEndResult& seen = bench.see(sequence.frame(i).pair(), last, i == 0 ? truth : off(truth, 0.02, 0.01));
    EXPECT_GT(seen.corners, 100);
    if (i == 0) {
      EXPECT_FALSE(seen.localised);
      EXPECT_GT(seen.fresh.size(), 20U);
    } else {
      ASSERT_TRUE(seen.localised) << i;
      EXPECT_LT(distanceBetween(seen.T_odom_camera, truth), 0.01) << i;
      EXPECT_LT(angleBetween(seen.T_odom_camera, truth), 0.003) << i;
      EXPECT_GT(seen.tracked.size(), 20U) << i;
      EXPECT_GT(seen.inlier_share, 0.7) << i;
      EXPECT_LT(seen.reprojection_px, 0.5) << i;
    }
    for (const Observation& o : seen.tracked) {
      EXPECT_EQ(o.frame, i);
      EXPECT_TRUE(o.z.allFinite());
      EXPECT_TRUE(o.information.allFinite());
      EXPECT_TRUE(bench.landmarks().count(o.landmark));
    }
    bench.learn(seen, truth);
    last = truth;
  }
}

TEST(FrontEnd, ToleratesARightImageWithARowOffset) {
  RenderedSequence sequence = room(20.0);
  const StereoCamera camera = makeCamera(sequence.options().camera);
  for (const int lower : {-1, 1, 2}) {
    Bench bench(camera);
    Pose last = sequence.T_world_camera(0);
    for (int i = 0; i < 6; ++i) {
      const Pose truth = sequence.T_world_camera(i);
      const StereoFrame frame = sequence.frame(i);
      StereoPair pair = frame.pair();
      std::vector<std::uint8_t> moved(320 * 240);
      for (int v = 0; v < 240; ++v) {
        const std::uint8_t* row = pair.right.data + std::clamp(v - lower, 0, 239) * pair.right.stride;
        std::copy(row, row + 320, moved.begin() + 320 * v);
      }
      pair.right = ImageView{moved.data(), 320, 240, 320};
      const FrontEndResult& seen = bench.see(pair, last, i == 0 ? truth : off(truth, 0.02, 0.01));
      if (i > 0) {
        ASSERT_TRUE(seen.localised) << lower;
        EXPECT_LT(distanceBetween(seen.T_odom_camera, truth), 0.01) << lower;
        EXPECT_LT(angleBetween(seen.T_odom_camera, truth), 0.003) << lower;
        EXPECT_GT(seen.tracked.size(), 20U) << lower;
        EXPECT_LT(seen.reprojection_px, 0.5) << lower;
      } else {
        EXPECT_GT(seen.fresh.size(), 20U) << lower;
      }
      bench.learn(seen, truth);
      last = truth;
    }
  }
}

TEST(FrontEnd, FirstObservationsHaveTheirStatedAccuracy) {
  RenderedSequence sequence = room(20.0);
  const StereoCamera camera = makeCamera(sequence.options().camera);
  Bench bench(camera);
  const Pose first = sequence.T_world_camera(0);
  const Scene scene = texturedRoom();
  const FrontEndResult& seen = bench.see(sequence.frame(0).pair(), first, first);
  int near = 0;
  double normalised = 0.0;
  for (const Observation& o : seen.fresh) {
    const Eigen::Vector3d ray = camera.left.ray(o.z.head<2>());
    const auto hit = scene.trace(first.t(), first.q() * ray);
    ASSERT_TRUE(hit);
    const double error = o.z.x() - o.z.z() - camera.left.fx * camera.baseline / hit->distance;
    if (std::abs(error) < 0.3) ++near;
    const double variance =
        Eigen::Vector3d(1.0, 0.0, -1.0).dot(Eigen::Matrix3d(o.information.inverse()) * Eigen::Vector3d(1.0, 0.0, -1.0));
    normalised += std::min(9.0, error * error / variance);
  }
  const double count = static_cast<double>(seen.fresh.size());
  EXPECT_GT(near, 0.75 * count);  // the others are on edges of nearer objects
  EXPECT_LT(normalised / count, 2.5);
}

TEST(FrontEnd, SwappedDarkAndAbsurdImagesGiveFewMatchesAndNoHarm) {
  RenderedSequence sequence = room(20.0);
  const StereoCamera camera = makeCamera(sequence.options().camera);
  Bench bench(camera);
  const Pose truth = sequence.T_world_camera(0);
  bench.learn(bench.see(sequence.frame(0).pair(), truth, truth), truth);
  const std::size_t known = bench.landmarks().size();

  const std::vector<std::uint8_t> black(320 * 240, 0), white(320 * 240, 255);
  std::vector<std::uint8_t> noise(320 * 240);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>((i * 2654435761U) >> 13);
  const auto view = [](const std::vector<std::uint8_t>& pixels) { return ImageView{pixels.data(), 320, 240, 320}; };
  const StereoPair good = sequence.frame(0).pair();
  const StereoPair swapped{1, good.right, good.left}, dark{2, view(black), view(black)},
      bright{3, view(white), good.right}, random{4, view(noise), view(noise)}, missing{5, ImageView(), good.right},
      wrong_size{6, {good.left.data, 200, 100, 320}, good.right};
  for (const StereoPair& pair : {swapped, dark, bright, random, missing, wrong_size}) {
    Bench fresh(camera);
    fresh.learn(fresh.see(good, truth, truth), truth);
    const FrontEndResult& seen = fresh.see(pair, truth, truth);
    EXPECT_TRUE(seen.T_odom_camera.isFinite());
    // measurements in a single image are correct as well
    if (pair.stamp != bright.stamp) {
      EXPECT_LT(static_cast<double>(seen.tracked.size()), 0.5 * static_cast<double>(known)) << pair.stamp;
    }
    for (const Observation& o : seen.fresh) EXPECT_TRUE(o.z.allFinite() && o.information.allFinite());
  }
}

TEST(FrontEnd, FindsAFirstStepThatNothingForetold) {
  SequenceOptions options;
  options.camera.fx = options.camera.fy = 720.0;
  options.camera.cx = 619.5;
  options.camera.cy = 187.5;
  options.camera.width = 1240;
  options.camera.height = 376;
  options.noise = 2.0;
  const Pose first = lookingAlong({0.2, 0.1, 1.2}, 0.3);
  for (const double metres : {1.0, 1.2, 1.4}) {
    Vector6d motion;
    motion << 0.1, 0.0, metres, 0.0, 0.06, 0.0;
    const Pose second = first * expSe3(motion);
    RenderedSequence sequence(
        texturedRoom(), [&](double t) { return t > 0.0 ? second : first; }, options);
    Bench bench(makeCamera(options.camera));
    bench.learn(bench.see(sequence.frame(0).pair(), first, first), first);
    const FrontEndResult& seen = bench.see(sequence.frame(1).pair(), first, first);
    ASSERT_TRUE(seen.localised) << metres;
    EXPECT_GT(seen.tracked.size(), 60U) << metres;
    EXPECT_LT(distanceBetween(seen.T_odom_camera, second), 0.02) << metres;
    EXPECT_LT(angleBetween(seen.T_odom_camera, second), 0.005) << metres;
  }
}

TEST(FrontEnd, GoesOnAfterDarkness) {
  RenderedSequence sequence = room(20.0);
  Bench bench(makeCamera(sequence.options().camera));
  Pose last = sequence.T_world_camera(0);
  int localised = 0;
  for (int i = 0; i < 8; ++i) {
    const Pose truth = sequence.T_world_camera(i);
    const std::vector<std::uint8_t> black(320 * 240, 0);
    const ImageView dark{black.data(), 320, 240, 320};
    const FrontEndResult& seen =
        i == 3 ? bench.see({0, dark, dark}, last, truth) : bench.see(sequence.frame(i).pair(), last, truth);
    EXPECT_FALSE(i == 3 && seen.localised);
    localised += seen.localised ? 1 : 0;
    bench.learn(seen, truth);
    last = truth;
  }
  EXPECT_GE(localised, 5);
}

TEST(FrontEnd, SameInputSameBits) {
  std::vector<double> values[2];
  for (auto& out : values) {
    RenderedSequence sequence = room(10.0);
    Bench bench(makeCamera(sequence.options().camera));
    Pose last = sequence.T_world_camera(0);
    for (int i = 0; i < 4; ++i) {
      const Pose truth = sequence.T_world_camera(i);
      const FrontEndResult& seen = bench.see(sequence.frame(i).pair(), last, truth);
      for (const auto* list : {&seen.tracked, &seen.fresh})
        for (const Observation& o : *list) {
          out.insert(out.end(), o.z.data(), o.z.data() + 3);
          out.insert(out.end(), o.information.data(), o.information.data() + 9);
        }
      bench.learn(seen, truth);
      last = truth;
    }
  }
  EXPECT_EQ(values[0], values[1]);
}

}  // namespace
}  // namespace swf_vo
