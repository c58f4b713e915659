// SPDX-License-Identifier: BSD-3-Clause
#include "input/message_decoder.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "errors.hpp"
#include "urban_nav_input/recording/connection_definition.hpp"
#include "urban_nav_input/recording/message_encoding.hpp"

namespace py = pybind11;

namespace urban_nav_python {

using urban_nav_core::StampNs;
using urban_nav_input::ByteView;
using urban_nav_input::FieldKind;
using urban_nav_input::MemberReader;
using urban_nav_input::MessageEncoding;
using urban_nav_input::MessageField;

namespace {

constexpr StampNs kNsPerSecond = 1'000'000'000;

/// Returns 'b', 'i', 'u' or 'f' for a built-in type. ROS 1 gives a byte a sign, and a char none.
char numberCode(const std::string& type) {
  if (type == "bool") return 'b';
  if (type == "char" || type[0] == 'u') return 'u';
  return type[0] == 'f' ? 'f' : 'i';
}

template <typename T>
T readNumber(const std::uint8_t* bytes, bool is_swapped) {
  std::uint8_t copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (is_swapped) std::reverse(copy, copy + sizeof(T));
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

py::object toSigned(const std::uint8_t* bytes, std::size_t size, bool is_swapped) {
  switch (size) {
    case 1: return py::int_(readNumber<std::int8_t>(bytes, is_swapped));
    case 2: return py::int_(readNumber<std::int16_t>(bytes, is_swapped));
    case 4: return py::int_(readNumber<std::int32_t>(bytes, is_swapped));
    default: return py::int_(readNumber<std::int64_t>(bytes, is_swapped));
  }
}

py::object toUnsigned(const std::uint8_t* bytes, std::size_t size, bool is_swapped) {
  switch (size) {
    case 1: return py::int_(readNumber<std::uint8_t>(bytes, is_swapped));
    case 2: return py::int_(readNumber<std::uint16_t>(bytes, is_swapped));
    case 4: return py::int_(readNumber<std::uint32_t>(bytes, is_swapped));
    default: return py::int_(readNumber<std::uint64_t>(bytes, is_swapped));
  }
}

py::object toNumber(char code, const std::uint8_t* bytes, std::size_t size, bool is_swapped) {
  switch (code) {
    case 'b': return py::bool_(*bytes != 0);
    case 'i': return toSigned(bytes, size, is_swapped);
    case 'u': return toUnsigned(bytes, size, is_swapped);
    default:
      return py::float_(size == sizeof(float) ? static_cast<double>(readNumber<float>(bytes, is_swapped))
                                              : readNumber<double>(bytes, is_swapped));
  }
}

/// Returns a time or duration, ns: seconds of a duration have a sign.
StampNs readTime(const std::uint8_t* bytes, bool is_duration, bool is_swapped) {
  const auto seconds = readNumber<std::uint32_t>(bytes, is_swapped);
  const auto rest = readNumber<std::uint32_t>(bytes + sizeof(seconds), is_swapped);
  if (!is_duration) return static_cast<StampNs>(seconds) * kNsPerSecond + static_cast<StampNs>(rest);
  return StampNs{static_cast<std::int32_t>(seconds)} * kNsPerSecond + StampNs{static_cast<std::int32_t>(rest)};
}

py::object toPython(ByteView text) { return toText({reinterpret_cast<const char*>(text.data), text.size}); }

/// Returns a list of `count` elements that `read` returns one by one.
template <typename Read>
py::object makeList(std::size_t count, const Read& read) {
  py::list list(count);
  for (std::size_t i = 0; i < count; ++i)
    PyList_SET_ITEM(list.ptr(), static_cast<Py_ssize_t>(i), read().release().ptr());
  return py::object(std::move(list));
}

ByteView toByteView(const py::array& bytes) {
  return {static_cast<const std::uint8_t*>(bytes.data()), static_cast<std::size_t>(bytes.size())};
}

}  // namespace

MessageDecoder::Member MessageDecoder::makeMember(const MessageField& field) {
  Member member;
  member.field = field;
  PyObject* name = PyUnicode_InternFromString(field.name.c_str());
  if (name == nullptr) throw py::error_already_set();
  member.name = py::reinterpret_steal<py::object>(name);
  member.is_duration = field.kind == FieldKind::Time && field.type.find("uration") != std::string::npos;
  if (field.kind == FieldKind::Text || field.kind == FieldKind::Time || field.kind == FieldKind::Message) return member;
  member.code = numberCode(field.type);
  const char letter = member.code == 'b' ? '?' : member.code;
  const std::string size = member.code == 'b' ? "" : std::to_string(urban_nav_input::numberSize(field.kind));
  member.native = py::dtype(std::string("<") + letter + size);
  member.swapped = py::dtype(std::string(">") + letter + size);
  return member;
}

MessageDecoder::MessageDecoder(const urban_nav_input::Connection& connection, const py::function& make_type)
    : is_cdr_(connection.encoding == "cdr") {
  if (!is_cdr_ && connection.encoding != "ros1")
    throw std::invalid_argument("its messages are encoded as " +
                                (connection.encoding.empty() ? "nothing" : connection.encoding));
  const urban_nav_input::MessageDefinition definition =
      urban_nav_input::withRos1Names(urban_nav_input::findDefinition(connection));
  for (const urban_nav_input::MessageLayout& each : definition.layouts) {
    Layout layout{each, {}, {}};
    py::list names;
    for (const MessageField& field : each.fields) {
      layout.members.push_back(makeMember(field));
      names.append(layout.members.back().name);
    }
    py::list constants;
    for (const std::string& constant : each.constants) constants.append(toText(constant));
    layout.type = make_type(each.type, py::tuple(names), constants);
    layouts_.push_back(std::move(layout));
  }
}

std::optional<MessageEncoding> MessageDecoder::findEncoding(ByteView bytes) const {
  return is_cdr_ ? urban_nav_input::cdrEncoding(bytes) : MessageEncoding::Ros1;
}

py::object MessageDecoder::decode(const py::array& bytes) const {
  const ByteView view = toByteView(bytes);
  const std::optional<MessageEncoding> encoding = findEncoding(view);
  if (!encoding)
    throw std::invalid_argument(
        "its messages are in a form of CDR that is not understood (XCDR2 or parameter lists)");
  MemberReader reader(view, *encoding);
  return readMessage(0, reader, bytes);
}

std::optional<StampNs> MessageDecoder::headerStamp(ByteView bytes) const {
  const std::vector<Member>& members = layouts_.front().members;
  const std::optional<MessageEncoding> encoding = findEncoding(bytes);
  if (!encoding || members.empty() || members.front().field.kind != FieldKind::Message) return std::nullopt;
  if (members.front().field.array != MessageField::Array::None) return std::nullopt;
  const Layout& header = layouts_[members.front().field.layout];
  if (header.layout.type != "std_msgs/Header") return std::nullopt;
  try {
    MemberReader reader(bytes, *encoding);
    for (const Member& member : header.members) {
      if (member.field.kind == FieldKind::Time) {
        const StampNs stamp = readTime(reader.numbers(2, 4).data, false, reader.isSwapped());
        return stamp == 0 ? std::nullopt : std::optional<StampNs>(stamp);
      }
      if (member.field.kind != FieldKind::Number4) return std::nullopt;
      reader.takeWord();
    }
  } catch (const std::runtime_error&) {
    // Damaged: reported when the message itself is read.
  }
  return std::nullopt;
}

py::object MessageDecoder::readMessage(std::size_t layout, MemberReader& reader, const py::array& bytes) const {
  const Layout& plan = layouts_[layout];
  reader.enter(plan.layout);
  auto* type = reinterpret_cast<PyTypeObject*>(plan.type.ptr());
  const py::tuple none;
  PyObject* created = type->tp_new(type, none.ptr(), nullptr);
  if (created == nullptr) throw py::error_already_set();
  py::object message = py::reinterpret_steal<py::object>(created);
  for (const Member& member : plan.members) {
    const py::object value = readMember(member, reader, bytes);
    if (PyObject_SetAttr(created, member.name.ptr(), value.ptr()) != 0) throw py::error_already_set();
  }
  return message;
}

py::object MessageDecoder::readMember(const Member& member, MemberReader& reader, const py::array& bytes) const {
  const MessageField& field = member.field;
  const bool is_array = field.array != MessageField::Array::None;
  const std::size_t count = reader.count(field);
  switch (field.kind) {
    case FieldKind::Text:
      return is_array ? makeList(count, [&] { return toPython(reader.text()); }) : toPython(reader.text());
    case FieldKind::Message: {
      const auto read = [&] { return readMessage(field.layout, reader, bytes); };
      return is_array ? makeList(count, read) : read();
    }
    case FieldKind::Time: {
      const auto read = [&]() -> py::object {
        return py::int_(readTime(reader.numbers(2, 4).data, member.is_duration, reader.isSwapped()));
      };
      return is_array ? makeList(count, read) : read();
    }
    default: break;
  }
  const std::size_t size = urban_nav_input::numberSize(field.kind);
  const ByteView numbers = reader.numbers(count, size);
  if (!is_array) return toNumber(member.code, numbers.data, size, reader.isSwapped());
  const py::object& type = reader.isSwapped() ? member.swapped : member.native;
  return py::array(py::reinterpret_borrow<py::dtype>(type), {static_cast<py::ssize_t>(count)},
                   {static_cast<py::ssize_t>(size)}, numbers.data, bytes);
}

}  // namespace urban_nav_python
