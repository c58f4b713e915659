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

/// Keyframe of a map that can be retrieved.
struct SearchedKeyframe {
  urban_nav_core::PoseRef at;  ///< the session by its id
  /// To the camera of the queries; null if it is the same one.
  std::shared_ptr<const KeyframeConversion> conversion = nullptr;
};

/// Retrieves keyframes of a map that may show the same place as a new one, as candidates for registration.
///
/// Interface between localization and place recognition, so that neither includes the other: the command connects them,
/// and the nodelet of the localization loads the implementation by pluginlib. Results do not depend on the number of
/// threads. Not thread-safe.
class KeyframeRetrieval {
 public:
  virtual ~KeyframeRetrieval() = default;

  /// Sets the keyframes to be retrieved; called once, before all other functions. `store` contains them, and must
  /// outlive this object, unchanged. Throws DataError if the store is damaged.
  virtual void open(urban_nav_store::Store& store, std::vector<SearchedKeyframe> keyframes) = 0;

  /// Returns the number of keyframes read so far, in the order of open(), including unusable ones.
  virtual std::size_t read() const = 0;
  /// Reads more keyframes, for at most some 10 ms. Returns false if all are read.
  virtual bool readNext() = 0;

  /// Returns the most likely keyframes of those read, as indices in open(), the best first, at most `most`. Empty if
  /// the image of `keyframe` cannot be used.
  virtual std::vector<std::size_t> find(const Keyframe& keyframe, std::size_t most) const = 0;
};

/// Creates a retrieval that is not open.
using KeyframeRetrievalFactory = std::function<std::shared_ptr<KeyframeRetrieval>()>;

}  // namespace urban_nav_registration
