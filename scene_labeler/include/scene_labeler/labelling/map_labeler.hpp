// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "scene_labeler/drive/drive_scene.hpp"
#include "scene_labeler/labelling/class_frequencies.hpp"
#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/labelling/mounting_check.hpp"

namespace scene_labeler {

/// Label of a map point. The probability has a resolution of 1/255.
struct PointLabel {
  SceneClass label = SceneClass::None;
  std::uint8_t probability = 0;  ///< times 255
  bool is_unsure = true;
};

/// Loadable image with its pose in the map.
struct PlacedView {
  urban_nav_core::RawCamera camera;
  urban_nav_core::Pose T_map_camera;  ///< of the optical frame, at the time of the image
  std::size_t image = 0;              ///< number passed to MapLabeler::Callbacks::load
  std::size_t device = 0;             ///< number of the camera: views of one camera share their mounting
};

/// Use of an image.
struct ViewUse {
  std::size_t shown = 0;        ///< points that it labels; 0 for an image that is black, saturated, empty or upside
                                ///< down
  bool is_upside_down = false;  ///< its camera appears to be mounted upside down: not used
  bool is_new_place = false;    ///< place of a kind that is not in the training data (isNewPlace)
  bool has_classes = false;     ///< a class image of another source was also used
};

/// Labels the points of a map, each from all images in which it is visible, the others by shape and by the labelled
/// points around them. Class images of another source are further views. Points must be added in rows along y and are
/// kept until the labels of their surroundings are known, so that memory depends on the width of the map, not on its
/// length. The result depends on the order of points and views only by rounding, and not on the number of threads. Not
/// thread-safe.
class MapLabeler {
 public:
  struct Options {
    int superpixel = 12;          ///< px
    double reach = 15.0;          ///< m, of a view
    double class_accuracy = 0.8;  ///< share of the pixels of class images that are right
  };
  struct Callbacks {
    /// Returns an image (CV_8UC3, blue, green, red) by its number; an empty one if unavailable.
    std::function<cv::Mat(std::size_t image)> load;
    /// Returns the classes of the same image by another source (CV_8U, SceneClass); an empty image if unavailable. May
    /// be empty.
    std::function<cv::Mat(std::size_t image)> load_classes;
    /// Called after each image.
    std::function<void(std::size_t image, const ViewUse& use)> take_view;
    /// Called once for each point, by its number in the order of addPoints().
    std::function<void(std::size_t point, const PointLabel& label)> take_label;
  };

  /// The model must outlive the labeler.
  MapLabeler(const LabelModel& model, const Options& options, std::vector<PlacedView> views, Callbacks callbacks);

  /// Adds points, m, about 5 cm apart. `reflectance`: one per point, from the robot's side lasers, normalised for range
  /// and incidence; NaN for points of other sensors, such as 3D LiDARs.
  void addPoints(const std::vector<Eigen::Vector3f>& points, const std::vector<float>& reflectance);
  /// Labels all points whose surroundings are complete. Later points must have a y of at least this value.
  void sweepTo(double y);
  /// Labels all remaining points.
  void finish();

  /// Returns the number of points that wait for labels of their surroundings.
  std::size_t heldPoints() const { return held_; }

 private:
  using Square = std::pair<int, int>;  // on the ground: row along y, column along x
  struct SquarePoints {
    std::vector<std::size_t> numbers;
    std::vector<Eigen::Vector3f> points;
    std::vector<float> reflectance;  // NaN: unknown
    std::vector<std::uint8_t> is_shown;
    std::vector<float> logs;  // per point and class, summed over views
    std::vector<std::uint16_t> views, unsure, in_new_place;
  };
  struct Member {
    SquarePoints* square = nullptr;
    std::size_t index = 0;
    const Eigen::Vector3f& point() const { return square->points[index]; }
  };
  /// Returns the points of the squares around one, up to `margin` squares away.
  std::vector<Member> pointsAround(const Square& middle, int margin);
  static Scene makeScene(const std::vector<Member>& members);
  void labelView(const PlacedView& view);
  /// Adds the class image of a view for the points labelled by that view. Returns false without one.
  bool voteByClasses(const PlacedView& view, const SceneView& shown, const std::vector<Member>& members);
  /// Returns the mounting check of a camera, which accumulates over its images.
  MountingCheck& findMounting(std::size_t device);
  void labelHidden(const Square& square, const SquarePoints& own);
  /// Propagates labels from images to the points of a square that are not visible in any image.
  void spreadInSquare(const std::vector<Member>& members, const std::vector<std::uint8_t>& is_asked);
  void vote(const std::vector<Member>& members, const SceneLabels& labels, bool by_image);
  void giveLabels(const SquarePoints& square);
  void labelRowsBelow(double y);

  const LabelModel& model_;
  const Options options_;
  const std::vector<PlacedView> views_;  // in the order of y
  const Callbacks callbacks_;
  ClassFrequencies frequencies_;
  std::size_t next_view_ = 0, next_point_ = 0, held_ = 0;
  int next_row_;  // of squares: earlier ones are labelled
  std::map<Square, SquarePoints> squares_;
  std::map<std::size_t, MountingCheck> mountings_;  // by device
};

}  // namespace scene_labeler
