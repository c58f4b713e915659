// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/page.hpp"
#include "topics/places/place_evaluation.hpp"

namespace urban_nav {

/// Returns the confusion matrix as a PNG: images from top to bottom, earlier images from left to right. Grey:
/// probability by words alone; blue: the same place in truth; green and red: announced above 0.99, right and wrong.
std::string confusionPng(const PlaceEvaluation& evaluation);

/// Returns the same for a page.
PagePicture confusionPagePicture(const PlaceEvaluation& evaluation);

}  // namespace urban_nav
