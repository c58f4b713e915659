// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "urban_nav_registration/retrieval/keyframe_retrieval.hpp"

namespace fabmap_node {

/// Number of stored features per keyframe for descriptor matching: 9 kB.
inline constexpr std::size_t kKeyframeLookFeatures = 250;

/// Finds keyframes by their words, and by descriptor matching for the likeliest ones.
///
/// Words and descriptors are those stored by `map`, with the model of most sessions of the map. A keyframe without
/// them, of another model or of another camera is described from its image, by the default model if there is no other:
/// about 10 ms instead of 0.1 ms each, and 9 kB of memory instead of 1 kB.
class KeyframePlaces final : public urban_nav_registration::KeyframeRetrieval {
 public:
  KeyframePlaces();
  ~KeyframePlaces() override;

  void open(urban_nav_store::Store& store, std::vector<urban_nav_registration::SearchedKeyframe> keyframes) override;
  std::size_t read() const override;
  bool readNext() override;
  std::vector<std::size_t> find(const urban_nav_registration::Keyframe& keyframe, std::size_t most) const override;

  /// Returns the number of keyframes that had to be described from their images.
  std::size_t described() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;  // null until open()
};

}  // namespace fabmap_node
