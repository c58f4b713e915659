// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "dense_stereo/disparity_image.hpp"
#include "dense_stereo/matcher.hpp"
#include "dense_stereo/parameters.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace dense_stereo {

/// Reason why a result is not OK: Status::reason of this stage.
enum class Reason : int {
  None = 0,
  ImageMissing,     ///< left, right or both are empty
  SizesDiffer,      ///< left and right have different sizes
  NoContrast,       ///< an image without brightness or texture
  Swapped,          ///< left and right are exchanged
  RowsDisagree,     ///< rows are not aligned: the right image is vertically shifted
  ExposureDiffers,  ///< brightness of the two images differs by more than a quarter; compensated
  LittleMatched,    ///< fewer than a tenth of the pixels are matched
};
const char* toString(Reason reason);

/// Result of one pair.
struct StereoResult {
  DisparityImage image;
  urban_nav_core::Status status;
  double answered = 0.0;    ///< share of the pixels with a disparity
  double exposure = 1.0;    ///< contrast of the left image divided by that of the right one
  double row_offset = 0.0;  ///< px by which the right image is shifted down; 0 if unknown
};

/// Dense disparities of rectified pairs (Newman et al. 2009, section 6.2). Deterministic; the result of a pair does not
/// depend on earlier pairs, nor on the number of threads. Allocates only when the size of the images changes. Not
/// thread-safe; different objects are independent.
class DenseStereo {
 public:
  /// `matcher`: null for semi-global matching. Throws UserError if `matcher` is null and `Parameters::method` is
  /// another method.
  explicit DenseStereo(const Parameters& parameters, std::unique_ptr<Matcher> matcher = nullptr);
  ~DenseStereo();
  DenseStereo(DenseStereo&&) noexcept;
  DenseStereo& operator=(DenseStereo&&) noexcept;

  /// Returns the disparities of the left image and their variances. For unusable pairs all pixels are invalid and the
  /// status states the reason. The result is valid until the next call.
  const StereoResult& process(const urban_nav_core::StereoPair& pair);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dense_stereo
