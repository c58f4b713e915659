// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/parameters.hpp"

#include <cstdint>

namespace scene_labeler {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "scene_labeler",
      {
          {"model", &P::model, "", "default", false, false, {},
           "Model of `labels train`, or `default`: that of simulated drives.", "scene_labeler/bench"},
          {"superpixel", &P::superpixel, "px", std::int64_t{12}, std::int64_t{4}, std::int64_t{200}, {},
           "Edge length of the superpixels; returns of a superpixel get the same class.",
           "paper 8.1", {}, Audience::Experts},
          {"precision", &P::precision, "", 0.98, 0.5, 0.999, {},
           "Share of the labels that are not unsure which is right, by the cross-validation of the model.",
           "docs/methods/scene_labeler.md"},
          {"spacing", &P::spacing, "m", 5.0, 0.5, 100.0, {},
           "Distance along the path between the images of each side camera that are labelled.", "docs/files.md", {},
           Audience::Experts},
          {"projection_distance", &P::projection_distance, "m", 10.0, 1.0, 100.0, {},
           "Length of path before and after an image from which returns are projected into it.",
           "field of view of the cameras", {"reach"}, Audience::Experts},
          {"class_topic", &P::class_topic, "", "", false, false, {},
           "Topic of class images from another source: mono8, with frame and stamp of an image of a side camera. "
           "Empty: none.",
           "docs/files.md"},
          {"class_file", &P::class_file, "", "", false, false, {},
           "Classes of the values of the class images: kitti, semantickitti, nuscenes, or a table id,class; empty: the "
           "classes' own numbers.", "docs/files.md"},
          {"class_accuracy", &P::class_accuracy, "", 0.8, 0.2, 0.99, {},
           "Share of correct pixels of class images.", "assumed"},
          {"samples", &P::samples, "", std::int64_t{3000}, std::int64_t{100}, std::int64_t{100000}, {},
           "Number of training samples per class, from all sources together.",
           "scene_labeler/bench", {}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace scene_labeler
