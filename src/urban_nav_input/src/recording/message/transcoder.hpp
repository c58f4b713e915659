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

/// Serializes messages of one definition and encoding anew by another definition and encoding: between ROS 1 and CDR,
/// and between versions of a type. Members belong together by their names, whatever the case of letters; one that the
/// source lacks becomes 0 or empty, one that the target lacks is left out. Not thread-safe.
class Transcoder {
 public:
  /// Throws std::invalid_argument with the reason why the source cannot become the target: a member of another type, or
  /// another order of members.
  Transcoder(MessageDefinition source, MessageDefinition target);

  /// Returns whether all members are in both, but for std_msgs/Header.seq: the same bytes have the same meaning.
  bool isSame() const { return is_same_; }
  /// Returns a message in the target's definition, valid until the next call. `to`: Ros1 or CdrLittleEndian. Throws
  /// std::runtime_error if the bytes end before the message.
  ByteView convert(ByteView bytes, MessageEncoding from, MessageEncoding to);

 private:
  /// A member is copied if both are there, skipped for the source alone, set to 0 for the target alone.
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
