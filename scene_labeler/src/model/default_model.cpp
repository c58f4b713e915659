// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/label_model.hpp"

// The model files are embedded in the library, so that they are available wherever the library is installed.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    "scene_labeler_default_model_begin:\n"
    ".incbin \"" SCENE_LABELER_DEFAULT_MODEL
    "\"\n"
    "scene_labeler_default_model_end:\n"
    ".balign 16\n"
    "scene_labeler_cloud_model_begin:\n"
    ".incbin \"" SCENE_LABELER_CLOUD_MODEL
    "\"\n"
    "scene_labeler_cloud_model_end:\n"
    ".popsection\n");

extern "C" {
extern const char begin_of_default_labels[] __asm__("scene_labeler_default_model_begin");
extern const char end_of_default_labels[] __asm__("scene_labeler_default_model_end");
extern const char begin_of_cloud_labels[] __asm__("scene_labeler_cloud_model_begin");
extern const char end_of_cloud_labels[] __asm__("scene_labeler_cloud_model_end");
}

namespace scene_labeler {

std::string_view defaultModelBytes() {
  return {begin_of_default_labels, static_cast<std::size_t>(end_of_default_labels - begin_of_default_labels)};
}

std::string_view defaultCloudModelBytes() {
  return {begin_of_cloud_labels, static_cast<std::size_t>(end_of_cloud_labels - begin_of_cloud_labels)};
}

LabelModel defaultModel() {
  LabelModel model = parseModel(defaultModelBytes(), "default model");
  model.of_other_devices =
      std::make_shared<const LabelModel>(parseModel(defaultCloudModelBytes(), "default model of clouds"));
  return model;
}

}  // namespace scene_labeler
