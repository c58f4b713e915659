// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "urban_nav_core/image/slope.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// The piece of an image that a landmark is recognised by, and its alignment to other images: coarse by mean-removed
/// SAD (Newman et al. 2009, section 2.4 iii), then to a hundredth of a pixel by inverse compositional alignment (Baker
/// and Matthews 2004) with gain and offset left free.
///
/// Images are read through a cubic B-spline as a smoothing kernel, templates through the same one: its alias at any
/// phase is (w / (2 pi - w))^4 of the signal (1 % at 4 px wavelength, where linear interpolation has 11 %), so the bias
/// of a position stays below 0.02 px at every phase. The gradient is the template's alone: noise of the current image
/// enters linearly and cannot pull the minimum to the phase where interpolation smooths most. All functions are pure;
/// positions are in px of the image handed in.

inline constexpr int kPatchRadius = 5;  ///< the window is 11 x 11, Gaussian-weighted
inline constexpr int kPatchSize = 2 * kPatchRadius + 1;
inline constexpr int kPatchStride = 12;  ///< rows padded to whole vectors; the padding has no weight
using PatchGrid = std::array<float, kPatchSize * kPatchStride>;

/// Pixels around a corner as they were when it was first seen; wider than the window, so that they can be turned and
/// scaled.
struct PatchSource {
  static constexpr int kRadius = 11;
  static constexpr int kSize = 2 * kRadius + 1;
  static constexpr int kStride = 24;
  std::array<std::uint8_t, kSize * kStride> pixels{};
};

/// Empty if (u, v) is nearer than 8 px to the border; beyond the border the last pixel is repeated.
std::optional<PatchSource> cutSource(const ImageView& image, int u, int v);

/// The most that a source is to be blurred by, px^2 along each axis: of details of a pixel little is left then, and
/// where that seems to stand depends on how exactly the camera blurs.
inline constexpr double kLargestBlur = 1.0;
/// The source as a camera would see it that is less sharp by a Gaussian of this variance (px^2 of the source along rows
/// and columns, 0 ... kLargestBlur).
PatchSource blurred(const PatchSource& source, const Eigen::Vector2d& variance);

/// How the pixels around a place move into another view: what is p from the middle of the source stands at A p / (1 +
/// bend . p) there.
struct PatchWarp {
  PatchWarp(const Eigen::Matrix2d& linear = Eigen::Matrix2d::Identity(),
            const Eigen::Vector2d& perspective = Eigen::Vector2d::Zero())
      : A(linear), bend(perspective) {}
  Eigen::Matrix2d A;
  Eigen::Vector2d bend;  ///< 1/px
};

/// A source as it should look in another view, ready for alignment: a shift is a product of the filters with the image.
struct alignas(16) PatchTemplate {
  PatchGrid value{};                 ///< grey levels, smoothed by the spline
  PatchGrid filter_x{}, filter_y{};  ///< weighted gradient, made blind to offset and gain
  PatchGrid filter_gain{};           ///< weighted deviation from the mean
  PatchWarp warp;                    ///< from the source, that it was made for
  Eigen::Matrix2d inverse_hessian = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d unit_covariance =
      Eigen::Matrix2d::Zero();  ///< of a shift, for one grey level of white pixel noise in the view
  Eigen::Vector2d view_blur =
      Eigen::Vector2d::Zero();  ///< b along rows and columns of the (b, 1 - 2 b, b) that makes the view as blurred
  double energy = 0.0;          ///< weighted variance, grey levels^2
};

inline constexpr double kLargestBend = 0.05;  ///< 1/px: a quarter larger or smaller at the window's border
/// Fills `made` with the source warped. False if it has no texture in some direction, or the warp is degenerate (scale
/// outside 0.4 ... 2.5, perspective of more than kLargestBend); `made` is then of no use.
bool warpTemplate(const PatchSource& source, const PatchWarp& warp, PatchTemplate& made);

/// Where `other`, a template of the same size, seems to stand in `patch`, px: by how much what it has more or less of
/// moves it.
Eigen::Vector2d displacement(const PatchTemplate& patch, const PatchTemplate& other);

struct Alignment {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of the template's middle in the image, px
  Eigen::Matrix2d covariance =
      Eigen::Matrix2d::Zero();  ///< px^2, from the noise of this image alone (the template's is common to all views)
  double gain = 1.0;            ///< contrast of the image over that of the template
  double correlation = 0.0;     ///< weighted, -1 ... 1
  double noise = 0.0;           ///< standard deviation of a pixel, from the residual, grey levels
  bool converged = false;       ///< all else is of no use if false
};

/// Aligns the template to the image from `start`. Not converged if it leaves the image, moves further than `reach` px,
/// or the image does not look like the template at all (gain <= 0).
Alignment alignPatch(const ImageView& image, const PatchTemplate& patch, const Eigen::Vector2d& start,
                     double reach = 3.0);

/// How alike the image is to the template with its middle at `at`, without looking for a better place: weighted
/// correlation, -1 ... 1; zero where the window leaves the image.
double correlationAt(const ImageView& image, const PatchTemplate& patch, const Eigen::Vector2d& at);

/// Alignment across a rectified pair: also how the disparity varies over the window.
struct SlopedAlignment {
  Alignment alignment;  ///< covariance with the slopes marginalised
  Eigen::Vector2d slopes =
      Eigen::Vector2d::Zero();  ///< d(disparity)/d(u_left, v_left): a road has (0, baseline / height)
  Slope seen;                   ///< what these pixels say of them
};
/// `usual_slope`: of disparities on surfaces at 45 deg to the line of sight. `made` returns the template of the other
/// image at the slopes found.
SlopedAlignment alignAcross(const ImageView& image, const PatchSource& source, const Eigen::Vector2d& start,
                            double usual_slope, PatchTemplate& made);

/// What a later view says of how a piece of surface leans: pixel p of the source (from its middle) stands at A p +
/// direction (slant . p) in the view, so that `direction` says how far the camera has moved for the purpose. From an
/// alignment of `patch`, which was made from `source` at the slant `assumed`. Nothing is seen where the alignment is of
/// no use.
void seeSlant(const ImageView& image, const PatchSource& source, const PatchTemplate& patch, const Alignment& alignment,
              const Eigen::Vector2d& direction, const Eigen::Vector2d& assumed, Slope& slant);

/// 8 columns (-4 ... 3) by 9 rows (-4 ... 4) of grey levels, mean removed.
struct alignas(16) SadPatch {
  static constexpr int kColumns = 8, kRows = 9;
  std::array<std::int16_t, kColumns * kRows> value{};
};
SadPatch sadPatch(const PatchTemplate& patch);
/// (u, v) as for meanRemovedSad.
SadPatch sadPatch(const ImageView& image, int u, int v);
/// May the patch stand at (u, v)?
inline bool sadFits(const ImageView& image, int u, int v) {
  return u >= 4 && v >= 4 && u + 3 < image.width && v + 4 < image.height;
}
/// Sum over the patch of |image - mean(image) - patch|, grey levels; needs sadFits.
int meanRemovedSad(const SadPatch& patch, const ImageView& image, int u, int v);
/// The same at `count` places side by side, from (u, v) to the right, all of which need sadFits.
void meanRemovedSads(const SadPatch& patch, const ImageView& image, int u, int v, int count, int* sads);

}  // namespace urban_nav_core
