// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/parameters.hpp"
#include "live/live_places.hpp"
#include "support/square_images.hpp"
#include "support/temporary_folder.hpp"
#include "urban_nav_core/testing/parameter_effects.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::StampNs;
using Experiment = urban_nav_core::testing::ParameterExperiment<Parameters>;

constexpr StampNs kStreetStep = 1'000'000'000;
constexpr double kStreetMetresPerStep = 1.0;

/// Image of a place on a day. A share of the grey levels is clutter specific to the day: a quarter at the first place,
/// more further along the street, so that some places are recognised with certainty and others not.
cv::Mat drawStreet(unsigned place, unsigned camera, unsigned day) {
  const double clutter = 0.25 + 0.015 * place;
  return (1.0 - clutter) * testing::drawSquares(place, camera) +
         clutter * testing::drawSquares(1000 + 100 * day + place, camera);
}

/// Beliefs and closures of a robot that drives along a street of 24 places on two days, on the second day twice past
/// the first places.
class StreetDrives {
 public:
  StreetDrives(const Parameters& parameters, unsigned cameras) : places_(parameters, {}, ""), cameras_(cameras) {}

  std::string run() {
    for (unsigned i = 0; i < 24; ++i) observe(0, i, i, 1);
    for (unsigned i = 0; i < 24; ++i) observe(-100, i, i, 2);
    for (unsigned i = 0; i < 4; ++i) observe(-100, 24 + i, 14 + i, 3);
    return text_;
  }

 private:
  void observe(int start, unsigned step, unsigned place, unsigned day) {
    const StampNs stamp = (1'000'000 + start + static_cast<int>(step)) * kStreetStep;
    places_.addOdometry({stamp, {urban_nav_core::Quaterniond::Identity(), {kStreetMetresPerStep * step, 0.0, 0.0}}});
    std::vector<cv::Mat> images;
    for (unsigned camera = 0; camera < cameras_; ++camera) images.push_back(drawStreet(place, camera, day));
    std::vector<urban_nav_core::ImageView> views;
    for (const cv::Mat& image : images) views.push_back({image.data, image.cols, image.rows, image.cols});
    const PlaceOutput output = places_.process(stamp, views);
    text_ += std::to_string(step) + " " + toString(output.belief.knowledge) + " " +
             std::to_string(output.belief.p_new) + " " + std::to_string(output.belief.words);
    for (const auto& closure : output.closures)
      text_ += " " + std::to_string(closure.a.stamp) + " " + std::to_string(closure.probability);
    text_ += "\n";
  }

  LivePlaces places_;
  const unsigned cameras_;
  std::string text_;
};

std::string driveWithOneCamera(const Parameters& parameters) { return StreetDrives(parameters, 1).run(); }
std::string driveWithTwoCameras(const Parameters& parameters) { return StreetDrives(parameters, 2).run(); }

TEST(Parameters, EachChangesWhatIsRecognisedOrProposed) {
  PlaceModel other = defaultModel();
  other.single.bias -= 1.0;
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("other.places"), std::ios::binary) << printModel(other);
  const std::vector<Experiment> experiments = {
      {"street by one camera",
       driveWithOneCamera,
       {{"model", folder.file("other.places")},
        {"known_probability", 0.5},
        {"closure_probability", 0.98},
        {"closures_per_metre", 0.2},
        {"enough_closures", 100.0},
        {"mask", 5.0},
        {"descriptor_matching", false},
        {"sequence", false},
        {"image_features", std::int64_t{100}}}},
      {"street by a panorama", driveWithTwoCameras, {{"panorama_features", std::int64_t{100}}}},
  };
  EXPECT_EQ(urban_nav_core::testing::findParametersWithoutEffect(table(), experiments), "");
}

}  // namespace
}  // namespace fabmap_node
