// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/render.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace urban_nav_core::testing {

/// 8-bit grey pixels without gaps between the rows; empty where an image is missing.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  ImageView view() const { return pixels.empty() ? ImageView{} : ImageView{pixels.data(), width, height, width}; }
};

/// A stereo pair that owns its pixels.
struct StereoFrame {
  StampNs stamp = 0;
  GreyImage left, right;

  StereoPair pair() const { return {stamp, left.view(), right.view()}; }
};

/// The renderer's camera as a stage knows it.
StereoCamera makeCamera(const RenderCamera& rendered);

/// How the sequence is taken.
struct SequenceOptions {
  RenderCamera camera;
  double rate = 20.0;      ///< Hz
  double noise = 1.0;      ///< standard deviation of the image noise, grey levels
  std::uint32_t seed = 1;  ///< of the noise: each frame and camera has its own
  double exposure = 0.0;   ///< s, about the stamp: what moves meanwhile is blurred
  StampNs first_stamp = 1'000'000'000;
  std::function<double(double t)> gain;  ///< exposure, a factor on the grey levels; none: 1
};

/// Frames of a scene along a motion, one at a time, in any order: frame i is the same whenever it is asked for.
class RenderedSequence {
 public:
  /// `scene(t)`: the scene at a time in s.
  RenderedSequence(std::function<Scene(double t)> scene, Motion motion, const SequenceOptions& options);
  /// A scene in which nothing moves.
  RenderedSequence(Scene scene, Motion motion, const SequenceOptions& options);

  const SequenceOptions& options() const { return options_; }
  double time(int i) const { return i / options_.rate; }
  StampNs stamp(int i) const;
  /// Exact pose of the left optical frame.
  Pose T_world_camera(int i) const { return motion_(time(i)); }
  /// The pair. Lives until the next call.
  const StereoFrame& frame(int i) { return frame(i, options_.noise); }
  /// The same with another standard deviation of the image noise, grey levels. What is seen is drawn once per frame:
  /// its further exposures are cheap.
  const StereoFrame& frame(int i, double noise);

 private:
  void draw(int i);
  void addRadiance(double t, float share);
  void expose(const std::vector<float>& radiance, double gain, double noise, std::uint64_t stream,
              GreyImage& image) const;

  std::function<Scene(double)> scene_;
  Scene still_;
  Motion motion_;
  SequenceOptions options_;
  Renderer renderer_;
  int drawn_ = -1;
  std::vector<float> radiance_left_, radiance_right_;  // of frame drawn_
  StereoFrame frame_;
};

}  // namespace urban_nav_core::testing
