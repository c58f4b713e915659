// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/keyframe/keyframe_conversion.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_registration {

/// Keyframe of a map that is to be found again.
struct SearchedKeyframe {
  urban_nav_core::PoseRef at;  ///< the session by its id
  /// To the camera of the queries; null if it is the same one.
  std::shared_ptr<const KeyframeConversion> conversion = nullptr;
};

/// Finds keyframes of a map that may show the same place as a new one: candidates for registration, which decides.
///
/// The seam between localization, which asks, and place recognition, which answers, so that neither includes the other:
/// the command joins the two, and the nodelet of the localization loads the implementation by pluginlib. The same calls
/// give the same results for any number of threads. Not thread-safe.
class KeyframeRetrieval {
 public:
  virtual ~KeyframeRetrieval() = default;

  /// Takes the keyframes that are to be found; called once, before all others. `store` holds them, and must outlive
  /// this object, unchanged. Throws DataError if the store is damaged.
  virtual void open(urban_nav_store::Store& store, std::vector<SearchedKeyframe> keyframes) = 0;

  /// Returns how many keyframes can be found by now, in the order of open(); those that cannot be used count too.
  virtual std::size_t read() const = 0;
  /// Reads some more keyframes, for at most some 10 ms. Returns false if none is left.
  virtual bool readNext() = 0;

  /// Returns the likeliest keyframes of those read, by their indices in open(), the best first, at most `most`. Empty
  /// if the image of `keyframe` cannot be used.
  virtual std::vector<std::size_t> find(const Keyframe& keyframe, std::size_t most) const = 0;
};

/// Makes a retrieval that is not open.
using KeyframeRetrievalFactory = std::function<std::shared_ptr<KeyframeRetrieval>()>;

}  // namespace urban_nav_registration
