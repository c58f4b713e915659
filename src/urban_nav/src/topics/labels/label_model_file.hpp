// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "scene_labeler/model/label_model.hpp"

namespace urban_nav {

/// A model with its digest.
struct NamedLabelModel {
  scene_labeler::LabelModel model;
  std::string digest;
};

/// Reads a model; `default` is that of the suite. `precision`: LabelModel::precision. Throws UserError for a damaged
/// file.
NamedLabelModel readLabelModel(const std::string& path, double precision = scene_labeler::kStandardPrecision);

}  // namespace urban_nav
