// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "front_end/noise_scale.hpp"
#include "observation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/image/patch.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

enum class Side { Left, Right };

/// A tracked landmark: its template, cut from the left image of its first observation, and the surface patch around it.
/// Every later measurement, in either image, aligns the current image to that template, so that errors of different
/// frames are independent.
struct Track {
  LandmarkId id = 0;
  FrameId born = 0;
  int level = 0;  ///< pyramid level of the template
  NoiseScale::Own noise;
  int seen = 1;                                     ///< frames with a trusted measurement
  int blurred = 0;                                  ///< consecutive trusted measurements in less sharp images
  int aside = 0;                                    ///< consecutive frames since then whose images were less or more
                                                    ///< sharp
  int missed = 0;                                   ///< consecutive frames without a match
  int disagreed = 0;                                ///< consecutive frames with a good match that contradicts the
                                                    ///< motion
  urban_nav_core::Pose T_born_odom;                 ///< transform from odom to the left camera of its first frame
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();   ///< direction of the template's centre in that camera, z = 1
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  ///< its surface there: plane . X = 1 (1/m); zero: at infinity
  urban_nav_core::Slope slant;                      ///< slant measured from pixels: plane.x and plane.y fx / fy, 1/m
  double slant_reach = 0.0;                         ///< baseline effective for the slant at its last update (m)
  Eigen::Matrix2d seen_as = Eigen::Matrix2d::Identity();  ///< warp to the left image of its last trusted measurement
  double sigma_disparity = 1.0;                           ///< sigma of the first observation, px
  Eigen::Vector3d z = Eigen::Vector3d::Zero();            ///< last trusted measurement: u_left, v, u_right (px)
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< information of `z`, from its alignments (1/px^2)
  FrameId measured = -1;                                  ///< frame of `z`
  urban_nav_core::PatchSource source;
  urban_nav_core::PatchTemplate in_left, in_right;  ///< last warped templates
  bool left_ready = false, right_ready = false;
  Eigen::Vector2d born_edges = Eigen::Vector2d::Zero();  ///< edgeVariance of the image of the template, px^2 of level 0
  /// Blur of the current images relative to that one, px^2 of its level along rows and columns, and the values with
  /// which the warped templates were made.
  Eigen::Vector2d blur = Eigen::Vector2d::Zero();
  Eigen::Vector2d made_blur_left = Eigen::Vector2d::Zero(), made_blur_right = Eigen::Vector2d::Zero();
  double row_difference_px = 0.0;  ///< row in the right image minus row in the left one, first observation
  bool sharper = false;            ///< the current images are much sharper than that one: no match possible
};

void archive(urban_nav_core::Archive& archive, Track& track);

/// Returns the landmark's surface for an inverse depth (1/z in the first camera) of `inverse_depth`.
Eigen::Vector3d surfaceAt(const Track& track, double inverse_depth);

/// Returns the warp of pixels around the landmark from its first left view to the current view, by the homography of
/// its surface (px of level 0). `inverse_depth`: 1/z of the landmark in the first camera, from the current map. Empty
/// if the landmark is behind the camera.
std::optional<urban_nav_core::PatchWarp> warpInto(Side side, const urban_nav_core::StereoCamera& camera,
                                                  const Track& track, const urban_nav_core::Pose& T_camera_born,
                                                  double inverse_depth);

/// Returns the displacement of a pixel next to the landmark per unit of surface slant: the `direction` of
/// urban_nav_core::seeSlant, m.
Eigen::Vector2d slantDirection(const urban_nav_core::StereoCamera& camera, const Track& track,
                               const urban_nav_core::Pose& T_camera_born, double inverse_depth);

/// The tracked landmarks. Storage is reused, so that nothing is allocated once `capacity` is reached; ids are never
/// reused.
class Tracks {
 public:
  explicit Tracks(int capacity);

  /// Starts a track with the next id; null if `capacity` is reached.
  Track* start();
  Track* find(LandmarkId id);
  void end(LandmarkId id);
  int size() const { return static_cast<int>(order_.size()); }
  /// Track by index, ordered by id.
  Track& at(int i) { return places_[order_[static_cast<std::size_t>(i)].place]; }
  LandmarkId idAt(int i) const { return order_[static_cast<std::size_t>(i)].id; }
  /// `levels`: number of pyramid levels of templates.
  void archive(urban_nav_core::Archive& archive, int levels);

 private:
  // A track is large; searching must not touch the others.
  struct Entry {
    LandmarkId id = 0;
    std::size_t place = 0;
  };
  std::vector<Entry>::iterator lowerBound(LandmarkId id);

  std::vector<Track> places_;
  std::vector<Entry> order_;  // ordered by id
  std::vector<std::size_t> free_;
  LandmarkId next_ = 0;
};

}  // namespace swf_vo
