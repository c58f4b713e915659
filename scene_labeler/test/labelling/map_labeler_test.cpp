// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/map_labeler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/pictured_yard.hpp"

namespace scene_labeler {
namespace {

/// Labels of points, with recorded callbacks.
struct LabelledYard {
  std::vector<PointLabel> labels;
  std::vector<int> times;                         // number of labels per point
  std::vector<std::size_t> shown;                 // per view
  std::size_t upside_down = 0, class_images = 0;  // views
  std::size_t most_held = 0;
};

/// Labels points in order of y, a metre at a time; `at_once`: adds all before any is labelled.
LabelledYard labelPoints(std::vector<Eigen::Vector3f> points, std::vector<PlacedView> views, const cv::Mat& image,
                         bool at_once = false, const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted),
                         const cv::Mat& classes = {}) {
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); });
  LabelledYard made;
  made.labels.resize(points.size());
  made.times.resize(points.size(), 0);
  MapLabeler::Callbacks callbacks;
  callbacks.load = [&](std::size_t) { return image; };
  callbacks.load_classes = [&](std::size_t) { return classes; };
  callbacks.take_view = [&](std::size_t, const ViewUse& use) {
    made.shown.push_back(use.shown);
    made.upside_down += use.is_upside_down ? 1U : 0U;
    made.class_images += use.has_classes ? 1U : 0U;
  };
  callbacks.take_label = [&](std::size_t point, const PointLabel& label) {
    made.labels[point] = label;
    ++made.times[point];
  };
  MapLabeler::Options options;
  options.class_accuracy = 0.98;
  MapLabeler labeler(model, options, std::move(views), callbacks);
  for (std::size_t begin = 0; begin < points.size();) {
    const float row = points[begin].y();
    if (!at_once) labeler.sweepTo(static_cast<double>(row));
    std::size_t end = begin;
    while (end < points.size() && points[end].y() < row + 1.0F) ++end;
    labeler.addPoints(
        {points.begin() + static_cast<std::ptrdiff_t>(begin), points.begin() + static_cast<std::ptrdiff_t>(end)},
        std::vector<float>(end - begin, 100.0F));
    made.most_held = std::max(made.most_held, labeler.heldPoints());
    begin = end;
  }
  labeler.finish();
  EXPECT_EQ(labeler.heldPoints(), 0U);
  return made;
}

/// Camera that faces the wall along x.
PlacedView viewAt(double x, double y) {
  PlacedView view;
  view.camera.pinhole = {100.0, 100.0, 50.0, 40.0, 101, 81};
  Eigen::Matrix3d R_map_camera;
  R_map_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  view.T_map_camera = urban_nav_core::Pose(Eigen::Quaterniond(R_map_camera), {x, y, 1.0});
  return view;
}

const cv::Mat kGreyImage(81, 101, CV_8UC3, cv::Scalar(90, 100, 110));

TEST(MapLabeler, LabelsEveryPointOnceByShapeWhereNoImageShowsIt) {
  testing::Yard yard = testing::makeYard(31);
  std::vector<std::pair<Eigen::Vector3f, SceneClass>> sorted;
  for (std::size_t i = 0; i < yard.labels.size(); ++i) sorted.emplace_back(yard.scene.points[i], yard.labels[i]);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first.y() < b.first.y(); });
  const LabelledYard made = labelPoints(yard.scene.points, {}, {});
  EXPECT_EQ(std::count(made.times.begin(), made.times.end(), 1), static_cast<std::ptrdiff_t>(yard.labels.size()));
  std::size_t right = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) right += made.labels[i].label == sorted[i].second ? 1U : 0U;
  EXPECT_GT(right, sorted.size() * 9 / 10);
}

TEST(MapLabeler, GivesNoLabelToPointsThatAreNotFinite) {
  std::vector<PointLabel> labels;
  MapLabeler::Callbacks callbacks;
  callbacks.take_label = [&](std::size_t, const PointLabel& label) { labels.push_back(label); };
  MapLabeler labeler(testing::trainOnYards(ClassifierKind::Boosted), MapLabeler::Options(), {}, callbacks);
  labeler.addPoints({{std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}}, {100.0F});
  labeler.finish();
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].label, SceneClass::None);
  EXPECT_TRUE(labels[0].is_unsure);
}

TEST(MapLabeler, UsesAnImageForThePointsThatItShows) {
  const testing::Yard yard = testing::makeYard(32);
  const LabelledYard made = labelPoints(yard.scene.points, {viewAt(4.0, 4.0), viewAt(4000.0, 4.0)}, kGreyImage);
  ASSERT_EQ(made.shown.size(), 1U) << "the other one is elsewhere";
  EXPECT_GT(made.shown[0], 500U);
  EXPECT_LT(made.shown[0], yard.labels.size());
  EXPECT_EQ(labelPoints(yard.scene.points, {viewAt(4.0, 4.0)}, {}).shown, std::vector<std::size_t>{0}) << "no image";
  EXPECT_EQ(labelPoints(yard.scene.points, {viewAt(4.0, 4.0)}, cv::Mat(81, 101, CV_8UC3, cv::Scalar::all(0))).shown,
            std::vector<std::size_t>{0})
      << "a covered camera";
}

TEST(MapLabeler, FollowsClassImagesAtThePointsThatTheirImageShows) {
  const testing::Yard yard = testing::makeYard(32);
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const auto label = [&](const cv::Mat& classes) {
    return labelPoints(yard.scene.points, {viewAt(4.0, 4.0)}, kGreyImage, false, model, classes);
  };
  const auto image_of = [](SceneClass of_all, int width = 101) {
    return cv::Mat(81, width, CV_8UC1, cv::Scalar(static_cast<double>(toIndex(of_all))));
  };
  const LabelledYard without = label({}), foliage = label(image_of(SceneClass::Foliage));
  EXPECT_EQ(without.class_images, 0U);
  EXPECT_EQ(foliage.class_images, 1U);
  std::size_t became_foliage = 0, became_unsure = 0, confirmed = 0;
  for (std::size_t i = 0; i < foliage.labels.size(); ++i) {
    const PointLabel &before = without.labels[i], &after = foliage.labels[i];
    if (before.label == SceneClass::Foliage) {
      ASSERT_EQ(after.label, SceneClass::Foliage);
      confirmed += after.probability >= before.probability ? 1U : 0U;
    } else if (after.label == SceneClass::Foliage) {
      ++became_foliage;
    } else if (after.probability < before.probability) {
      ++became_unsure;
    }
  }
  EXPECT_GT(became_foliage + became_unsure, without.shown.at(0) / 2) << "ground and wall visible in the image";
  EXPECT_LT(became_foliage + became_unsure, yard.labels.size() - 2000) << "only points visible in the image";
  EXPECT_GT(became_foliage, 0U) << "where the model was not sure";
  EXPECT_GT(confirmed, 0U);
  for (const cv::Mat& silent : {image_of(SceneClass::Vehicle), image_of(SceneClass::Foliage, 50)}) {
    const LabelledYard made = label(silent);
    for (std::size_t i = 0; i < made.labels.size(); ++i)
      ASSERT_EQ(made.labels[i].label, without.labels[i].label) << "unknown class, different size";
  }
}

TEST(MapLabeler, LeavesOutTheImagesOfACameraThatIsUpsideDown) {
  const testing::Yard yard = testing::makePicturedYard(9);
  const LabelModel model = testing::makePictureModel(measureFeatures(yard.scene, FeatureSet::All));
  PlacedView view = viewAt(-1.0, 4.0);
  view.camera.pinhole = {150.0, 150.0, 160.0, 120.0, 320, 240};
  view.T_map_camera = urban_nav_core::Pose(view.T_map_camera.q(), {-1.0, 4.0, 1.2});
  const cv::Mat upright = yard.scene.view.image;
  cv::Mat turned;
  cv::rotate(upright, turned, cv::ROTATE_180);
  const std::vector<PlacedView> views(6, view);
  const LabelledYard seen = labelPoints(yard.scene.points, views, upright, false, model);
  EXPECT_EQ(seen.upside_down, 0U);
  EXPECT_GT(seen.shown.at(0), 200U);
  const LabelledYard made = labelPoints(yard.scene.points, views, turned, false, model);
  EXPECT_GE(made.upside_down, 4U) << "detected after one or two images";
  EXPECT_EQ(static_cast<std::size_t>(std::count(made.shown.begin(), made.shown.end(), 0U)), made.upside_down);
  std::vector<PlacedView> of_two = views;
  for (std::size_t i = 0; i < of_two.size(); ++i) of_two[i].device = i;
  EXPECT_EQ(labelPoints(yard.scene.points, of_two, turned, false, model).upside_down, 0U)
      << "cameras are checked separately";
}

TEST(MapLabeler, HoldsThePointsOfAPartOfALongMapAndLabelsThemAsIfItHeldAll) {
  std::vector<Eigen::Vector3f> points;
  std::vector<PlacedView> views;
  for (unsigned part = 0; part < 12; ++part) {
    for (const Eigen::Vector3f& point : testing::makeYard(40 + part).scene.points)
      points.push_back(point + Eigen::Vector3f(0.0F, 15.0F * static_cast<float>(part), 0.0F));
    views.push_back(viewAt(4.0, 15.0 * part + 4.0));
  }
  const LabelledYard swept = labelPoints(points, views, kGreyImage),
                     at_once = labelPoints(points, views, kGreyImage, true);
  EXPECT_EQ(std::count(swept.times.begin(), swept.times.end(), 1), static_cast<std::ptrdiff_t>(points.size()));
  EXPECT_LT(swept.most_held, points.size() * 6 / 10);
  EXPECT_EQ(swept.shown, at_once.shown);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(swept.labels[i].label, at_once.labels[i].label) << i;
    ASSERT_EQ(swept.labels[i].probability, at_once.labels[i].probability) << i;
    ASSERT_EQ(swept.labels[i].is_unsure, at_once.labels[i].is_unsure) << i;
  }
}

}  // namespace
}  // namespace scene_labeler
