// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/page.hpp"
#include "topics/places/place_evaluation.hpp"

namespace urban_nav {

/// Returns the confusion matrix as a PNG: images from top to bottom, earlier images from left to right. Grey:
/// probability by words only; blue: true revisits; green and red: reported above 0.99, correct and wrong.
std::string confusionPng(const PlaceEvaluation& evaluation);

/// Returns the confusion matrix as a picture of a page.
PagePicture confusionPagePicture(const PlaceEvaluation& evaluation);

}  // namespace urban_nav
