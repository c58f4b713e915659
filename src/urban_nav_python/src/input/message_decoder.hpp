// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/connection.hpp"
#include "urban_nav_input/recording/member_reader.hpp"
#include "urban_nav_input/recording/message_definition.hpp"

namespace urban_nav_python {

/// Decodes the messages of one connection into Python objects. Arrays of numbers are numpy views of the message's
/// bytes. Requires the interpreter's lock.
class MessageDecoder {
 public:
  /// `make_type(name, members, constants)` returns the Python class of a message type. Throws std::invalid_argument
  /// with the reason why messages of the connection cannot be decoded.
  MessageDecoder(const urban_nav_input::Connection& connection, const pybind11::function& make_type);

  /// Returns the message in `bytes` (uint8, one dimension), which the views keep alive. Throws std::invalid_argument
  /// for a form of CDR that is not understood, std::runtime_error if the bytes end before the message.
  pybind11::object decode(const pybind11::array& bytes) const;

  /// Returns the stamp of the header that a message begins with, ns; nullopt without header, for a stamp of zero, and
  /// for damaged bytes.
  std::optional<urban_nav_core::StampNs> headerStamp(urban_nav_input::ByteView bytes) const;

 private:
  struct Member {
    urban_nav_input::MessageField field;
    pybind11::object name;
    pybind11::object native, swapped;  ///< numpy's types of a number in either byte order
    char code = 0;                     ///< kind of number: 'b' boolean, 'i' signed, 'u' unsigned, 'f' floating point
    bool is_duration = false;
  };
  struct Layout {
    urban_nav_input::MessageLayout layout;
    pybind11::object type;
    std::vector<Member> members;
  };

  static Member makeMember(const urban_nav_input::MessageField& field);
  pybind11::object readMessage(std::size_t layout, urban_nav_input::MemberReader& reader,
                               const pybind11::array& bytes) const;
  pybind11::object readMember(const Member& member, urban_nav_input::MemberReader& reader,
                              const pybind11::array& bytes) const;
  std::optional<urban_nav_input::MessageEncoding> findEncoding(urban_nav_input::ByteView bytes) const;

  bool is_cdr_;
  std::vector<Layout> layouts_;
};

}  // namespace urban_nav_python
