// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// One measurement as passed to the stages.
struct InputEvent {
  std::string stream;  ///< "stereo", a topic
  urban_nav_core::StampNs stamp = 0;
  bool used = true;  ///< false: dropped, because of its stamp or for lack of time
};
bool operator==(const InputEvent& a, const InputEvent& b);

/// Order in which the stages of a session processed its measurements; with it a second run reproduces the same bytes.
class InputOrder {
 public:
  virtual ~InputOrder() = default;
  virtual void append(const SessionId& session, const InputEvent& event) = 0;
  virtual void forEach(const SessionId& session, const std::function<void(const InputEvent&)>& take) const = 0;
};

}  // namespace urban_nav_store
