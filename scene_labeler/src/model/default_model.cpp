// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/label_model.hpp"

// The model file is embedded in the library, so that a model is available wherever the library is installed.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    "scene_labeler_default_model_begin:\n"
    ".incbin \"" SCENE_LABELER_DEFAULT_MODEL
    "\"\n"
    "scene_labeler_default_model_end:\n"
    ".popsection\n");

extern "C" {
extern const char begin_of_default_labels[] __asm__("scene_labeler_default_model_begin");
extern const char end_of_default_labels[] __asm__("scene_labeler_default_model_end");
}

namespace scene_labeler {

std::string_view defaultModelBytes() {
  return {begin_of_default_labels, static_cast<std::size_t>(end_of_default_labels - begin_of_default_labels)};
}

LabelModel defaultModel() { return parseModel(defaultModelBytes(), "default model"); }

}  // namespace scene_labeler
