// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_model_file.hpp"

#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav {

namespace {

NamedLabelModel readNamedModel(const std::string& path) {
  if (path == "default")
    return {scene_labeler::defaultModel(),
            scene_labeler::modelDigest(std::string(scene_labeler::defaultModelBytes()) +
                                       std::string(scene_labeler::defaultCloudModelBytes()))};
  const std::string bytes = urban_nav_core::readBytes(path);
  return {scene_labeler::parseModel(bytes, path), scene_labeler::modelDigest(bytes)};
}

}  // namespace

NamedLabelModel readLabelModel(const std::string& path, double precision) {
  NamedLabelModel named = readNamedModel(path);
  named.model = scene_labeler::withPrecision(std::move(named.model), precision);
  return named;
}

}  // namespace urban_nav
