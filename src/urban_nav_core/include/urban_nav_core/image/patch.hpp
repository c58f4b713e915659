// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "urban_nav_core/image/slope.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Image patch of a landmark, and its alignment to other images: coarse by mean-removed SAD (Newman et al. 2009,
/// section 2.4 iii), then to a hundredth of a pixel by inverse compositional alignment (Baker and Matthews 2004) with
/// free gain and offset.
///
/// Images and templates are sampled through the same cubic B-spline, used as a smoothing kernel. Its aliasing at any
/// phase is (w / (2 pi - w))^4 of the signal (1 % at 4 px wavelength, where linear interpolation has 11 %), so the
/// position bias stays below 0.02 px at every phase. Only the template's gradient is used: noise of the current image
/// enters linearly and cannot pull the minimum to the phase where interpolation smooths most. All functions are pure;
/// positions are in px of the given image.

inline constexpr int kPatchRadius = 5;  ///< the window is 11 x 11, Gaussian-weighted
inline constexpr int kPatchSize = 2 * kPatchRadius + 1;
inline constexpr int kPatchStride = 12;  ///< rows padded to whole SIMD vectors; the padding has zero weight
using PatchGrid = std::array<float, kPatchSize * kPatchStride>;

/// Pixels around a corner in the image of its first observation; larger than the window, for rotation and scaling.
struct PatchSource {
  static constexpr int kRadius = 11;
  static constexpr int kSize = 2 * kRadius + 1;
  static constexpr int kStride = 24;
  std::array<std::uint8_t, kSize * kStride> pixels{};
};

/// Returns the patch at (u, v); empty nearer than 8 px to the border. Beyond the border the last pixel is repeated.
std::optional<PatchSource> cutSource(const ImageView& image, int u, int v);

/// Largest blur of a source, px^2 along each axis. With more, little of the pixel-scale detail is left, and its
/// apparent position depends on the exact shape of the camera's blur.
inline constexpr double kLargestBlur = 1.0;
/// Returns the source blurred by a Gaussian of this variance (px^2 of the source along rows and columns, 0 ...
/// kLargestBlur), as a less sharp camera would have recorded it.
PatchSource blurred(const PatchSource& source, const Eigen::Vector2d& variance);

/// Warp of the pixels around a position into another view: offset p from the centre of the source maps to A p / (1 +
/// bend . p).
struct PatchWarp {
  PatchWarp(const Eigen::Matrix2d& linear = Eigen::Matrix2d::Identity(),
            const Eigen::Vector2d& perspective = Eigen::Vector2d::Zero())
      : A(linear), bend(perspective) {}
  Eigen::Matrix2d A;
  Eigen::Vector2d bend;  ///< 1/px
};

/// Source warped for another view, prepared for alignment: a shift is an inner product of the filters with the image.
struct alignas(16) PatchTemplate {
  PatchGrid value{};                 ///< grey levels, smoothed by the spline
  PatchGrid filter_x{}, filter_y{};  ///< weighted gradient, orthogonal to offset and gain
  PatchGrid filter_gain{};           ///< weighted deviation from the mean
  PatchWarp warp;                    ///< from the source to this template
  Eigen::Matrix2d inverse_hessian = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d unit_covariance =
      Eigen::Matrix2d::Zero();  ///< of a shift, for white pixel noise of one grey level in the view
  Eigen::Vector2d view_blur = Eigen::Vector2d::Zero();  ///< b along rows and columns of the kernel (b, 1 - 2 b, b) that
                                                        ///< blurs the view to match the template
  double energy = 0.0;                                  ///< weighted variance, grey levels^2
};

inline constexpr double kLargestBend = 0.05;  ///< 1/px: a quarter larger or smaller at the window's border
/// Computes the template of a warped source. Returns false, with `made` invalid, if it has no texture in some direction
/// or the warp is degenerate (scale outside 0.4 ... 2.5, perspective above kLargestBend).
bool warpTemplate(const PatchSource& source, const PatchWarp& warp, PatchTemplate& made);

/// Returns the apparent position of `other`, a template of the same size, in `patch`, px: the shift to first order that
/// the difference of their pixels causes.
Eigen::Vector2d displacement(const PatchTemplate& patch, const PatchTemplate& other);
/// Result of the alignment of a template with an image.
struct Alignment {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< of the template's centre in the image, px
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< px^2, from the noise of this image only (that of the
                                                         ///< template is common to all views)
  double gain = 1.0;                                     ///< ratio of the contrast of the image to that of the template
  double correlation = 0.0;                              ///< weighted, -1 ... 1
  double noise = 0.0;      ///< standard deviation of pixel noise, from the residual, grey levels
  bool converged = false;  ///< if false, all other members are invalid
};

/// Aligns the template to the image from `start`. Does not converge if the window leaves the image, moves further than
/// `reach` px, or is not positively correlated with the template (gain <= 0).
Alignment alignPatch(const ImageView& image, const PatchTemplate& patch, const Eigen::Vector2d& start,
                     double reach = 3.0);

/// Returns the weighted correlation of template and image with the template's centre at `at`, -1 ... 1, without a
/// search; zero where the window leaves the image.
double correlationAt(const ImageView& image, const PatchTemplate& patch, const Eigen::Vector2d& at);

/// Alignment between the images of a rectified pair, with the gradient of disparity over the window.
struct SlopedAlignment {
  Alignment alignment;  ///< covariance with the slopes marginalised
  Eigen::Vector2d slopes =
      Eigen::Vector2d::Zero();  ///< d(disparity)/d(u_left, v_left): a road has (0, baseline / height)
  Slope seen;                   ///< likelihood of the slopes from these pixels
};
/// Aligns a source of one image to the other. `usual_slope`: gradient of disparity of a surface at 45 deg to the line
/// of sight. `made` returns the template of the other image at the estimated slopes.
SlopedAlignment alignAcross(const ImageView& image, const PatchSource& source, const Eigen::Vector2d& start,
                            double usual_slope, PatchTemplate& made);

/// Adds to `slant` the information that a later view has on the slant of a surface: pixel p of the source (offset from
/// its centre) maps to A p + direction (slant . p), where `direction` grows with the baseline between the views. Uses
/// the alignment of `patch`, which was made from `source` at the slant `assumed`. No effect if the alignment did not
/// converge.
void seeSlant(const ImageView& image, const PatchSource& source, const PatchTemplate& patch, const Alignment& alignment,
              const Eigen::Vector2d& direction, const Eigen::Vector2d& assumed, Slope& slant);

/// 8 columns (-4 ... 3) by 9 rows (-4 ... 4) of grey levels, mean removed.
struct alignas(16) SadPatch {
  static constexpr int kColumns = 8, kRows = 9;
  std::array<std::int16_t, kColumns * kRows> value{};
};
SadPatch sadPatch(const PatchTemplate& patch);
/// Returns the patch with its reference pixel at (u, v), placed as for meanRemovedSad().
SadPatch sadPatch(const ImageView& image, int u, int v);
/// Returns whether the patch placed at (u, v) lies inside the image.
inline bool sadFits(const ImageView& image, int u, int v) {
  return u >= 4 && v >= 4 && u + 3 < image.width && v + 4 < image.height;
}
/// Returns the sum over the patch of |image - mean(image) - patch|, grey levels. Requires sadFits().
int meanRemovedSad(const SadPatch& patch, const ImageView& image, int u, int v);
/// Computes meanRemovedSad() at `count` adjacent positions, from (u, v) to the right. Requires sadFits() for all.
void meanRemovedSads(const SadPatch& patch, const ImageView& image, int u, int v, int count, int* sads);

}  // namespace urban_nav_core
