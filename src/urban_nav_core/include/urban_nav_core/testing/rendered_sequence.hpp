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

/// Returns the camera model of the renderer's camera.
StereoCamera makeCamera(const RenderCamera& rendered);

/// Acquisition of the sequence.
struct SequenceOptions {
  RenderCamera camera;
  double rate = 20.0;      ///< Hz
  double noise = 1.0;      ///< standard deviation of the image noise, grey levels
  std::uint32_t seed = 1;  ///< of the image noise, independent for each frame and camera
  double exposure = 0.0;   ///< s, centred on the stamp: motion during it blurs the image
  StampNs first_stamp = 1'000'000'000;
  std::function<double(double t)> gain;  ///< exposure as a factor on the grey levels; empty: 1
};

/// Frames of a scene along a motion, in any order: frame i is the same at every call.
class RenderedSequence {
 public:
  /// `scene(t)`: the scene at time t, s.
  RenderedSequence(std::function<Scene(double t)> scene, Motion motion, const SequenceOptions& options);
  /// Creates a sequence of a static scene.
  RenderedSequence(Scene scene, Motion motion, const SequenceOptions& options);

  const SequenceOptions& options() const { return options_; }
  double time(int i) const { return i / options_.rate; }
  StampNs stamp(int i) const;
  /// Returns the exact pose of the left optical frame.
  Pose T_world_camera(int i) const { return motion_(time(i)); }
  /// Returns the stereo pair. Valid until the next call.
  const StereoFrame& frame(int i) { return frame(i, options_.noise); }
  /// Returns the pair with another standard deviation of the image noise, grey levels. The scene is drawn once per
  /// frame: further exposures of it are cheap.
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
