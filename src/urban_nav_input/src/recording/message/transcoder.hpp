// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "urban_nav_input/recording/message_definition.hpp"
#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/message_encoding.hpp"

namespace urban_nav_input {

/// Converts messages of one definition and encoding to another definition and encoding: between ROS 1 and CDR, and
/// between versions of a type. Members are matched by their names, ignoring case; those missing in the source become 0
/// or empty, those missing in the target are omitted. Not thread-safe.
class Transcoder {
 public:
  /// Throws std::invalid_argument with the reason if the conversion is not possible: a member of another type, or
  /// another order of members.
  Transcoder(MessageDefinition source, MessageDefinition target);

  /// Returns whether both have the same members, except std_msgs/Header.seq, so that no conversion is needed.
  bool isSame() const { return is_same_; }
  /// Returns a message in the definition of the target, valid until the next call. `to`: Ros1 or CdrLittleEndian.
  /// Throws std::runtime_error if the bytes end before the message.
  ByteView convert(ByteView bytes, MessageEncoding from, MessageEncoding to);

 private:
  /// A member is copied if it is in both, skipped if only in the source, set to 0 if only in the target.
  struct Step {
    const MessageField* source = nullptr;
    const MessageField* target = nullptr;
  };
  using Plan = std::vector<Step>;

  const Plan& plan(std::size_t source, std::size_t target);
  void checkStep(const std::string& type, const Step& step);

  MessageDefinition source_, target_;
  std::map<std::pair<std::size_t, std::size_t>, Plan> plans_;  // key: layouts of source and target
  bool is_same_ = true;
  std::vector<std::uint8_t> out_;

  friend class TranscoderRun;
};

}  // namespace urban_nav_input
