// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <string>
#include <string_view>

#include "fabmap_node/model/place_model.hpp"

// The model file is embedded in the library, so that a model is available wherever the library is installed.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    "fabmap_node_default_model_begin:\n"
    ".incbin \"" FABMAP_NODE_DEFAULT_MODEL
    "\"\n"
    "fabmap_node_default_model_end:\n"
    ".popsection\n");

extern "C" {
extern const char begin_of_default_model[] __asm__("fabmap_node_default_model_begin");
extern const char end_of_default_model[] __asm__("fabmap_node_default_model_end");
}

namespace fabmap_node {

std::string_view defaultModelBytes() {
  return {begin_of_default_model, static_cast<std::size_t>(end_of_default_model - begin_of_default_model)};
}

std::optional<std::string_view> suppliedModel(const std::string& hash) {
  static const std::string hash_of_default = modelHash(defaultModelBytes());
  return hash == hash_of_default ? std::optional(defaultModelBytes()) : std::nullopt;
}

PlaceModel defaultModel() { return parseModel(defaultModelBytes(), "default model"); }

}  // namespace fabmap_node
