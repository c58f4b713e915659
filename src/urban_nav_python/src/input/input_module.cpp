// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "errors.hpp"
#include "input/message_decoder.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace py = pybind11;

namespace urban_nav_python {
namespace {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_input::ByteView;
using urban_nav_input::Connection;
using urban_nav_input::MessageSelection;
using urban_nav_input::RecordedMessage;
using urban_nav_input::Recording;

/// A recording with the decoders of its connections, which all iterators share.
class OpenRecording {
 public:
  OpenRecording(const std::string& path, py::function make_type)
      : path_(path), recording_(path), make_type_(std::move(make_type)) {}

  const std::string& path() const { return path_; }
  Recording& recording() { return recording_; }

  /// Returns the decoder of a connection; null, with the `reason`, if its messages cannot be decoded.
  const MessageDecoder* decoder(const Connection& connection, std::string& reason) {
    auto known = decoders_.find(&connection);
    if (known == decoders_.end()) {
      Entry entry;
      try {
        entry.decoder = std::make_unique<MessageDecoder>(connection, make_type_);
      } catch (const std::invalid_argument& error) {
        entry.reason = error.what();
      } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError)) throw;
        entry.reason = py::str(error.value()).cast<std::string>();
      }
      known = decoders_.emplace(&connection, std::move(entry)).first;
    }
    reason = known->second.reason;
    return known->second.decoder.get();
  }

  /// Returns [name, type, encoding, definition, number of messages] of every topic, by name.
  py::list topics() {
    std::map<std::string, Connection> by_name;
    for (const Connection& connection : recording_.connections()) by_name.emplace(connection.topic, connection);
    py::list all;
    for (const auto& [name, connection] : by_name)
      all.append(py::make_tuple(toText(name), toText(connection.type), toText(connection.encoding),
                                toText(connection.definition), recording_.count(name)));
    return all;
  }

 private:
  struct Entry {
    std::unique_ptr<MessageDecoder> decoder;
    std::string reason;
  };

  std::string path_;
  Recording recording_;
  py::function make_type_;
  std::map<const Connection*, Entry> decoders_;
};

/// Messages that a caller selects, and their form.
struct Wishes {
  std::optional<std::vector<std::string>> topics;
  std::optional<StampNs> begin, end;
  bool by_header = false, raw = false;
};

/// Yields (topic, receipt, message).
class MessageIterator {
 public:
  MessageIterator(std::shared_ptr<OpenRecording> recording, const Wishes& wishes)
      : recording_(std::move(recording)),
        selection_(select(*recording_, wishes)),
        is_raw_(wishes.raw),
        is_named_(wishes.topics.has_value()),
        is_sorted_(wishes.by_header) {
    if (is_sorted_) sort();
  }

  py::object next() {
    while (const std::optional<RecordedMessage> message = take()) {
      if (is_raw_) {
        const ByteView bytes = message->bytes();
        if (bytes.data == nullptr) continue;  // counted in the warnings of the recording
        return yield(*message, rawView(bytes));
      }
      if (py::object decoded = decode(*message); !decoded.is_none()) return yield(*message, decoded);
    }
    throw py::stop_iteration();
  }

 private:
  static MessageSelection select(OpenRecording& recording, const Wishes& wishes) {
    if (wishes.topics) checkTopics(recording, *wishes.topics);
    if (wishes.end && *wishes.end <= 0) return recording.recording().select(std::vector<std::string>());
    return recording.recording().select(wishes.topics, {wishes.begin.value_or(0), wishes.end.value_or(0)});
  }

  static void checkTopics(OpenRecording& recording, const std::vector<std::string>& topics) {
    const std::map<std::string, std::string> types = recording.recording().topicTypes();
    for (const std::string& topic : topics) {
      if (types.count(topic) != 0) continue;
      std::vector<std::string> names;
      for (const auto& [name, type] : types) names.push_back(name);
      throw UserError("topics: " + topic, "is not a topic of " + recording.path(), urban_nav_core::joined(names));
    }
  }

  void sort() {
    while (std::optional<RecordedMessage> message = selection_.next()) {
      std::string reason;
      const MessageDecoder* decoder = recording_->decoder(message->connection(), reason);
      const std::optional<StampNs> stamp = decoder == nullptr ? std::nullopt : decoder->headerStamp(message->bytes());
      order_.emplace_back(stamp.value_or(message->receipt()), all_.size());
      all_.push_back(*message);
    }
    std::sort(order_.begin(), order_.end());
  }

  std::optional<RecordedMessage> take() {
    if (!is_sorted_) return selection_.next();
    if (next_ == order_.size()) return std::nullopt;
    return all_[order_[next_++].second];
  }

  /// Returns a message; None if it is damaged or of a type that cannot be decoded.
  py::object decode(const RecordedMessage& message) {
    std::string reason;
    const MessageDecoder* decoder = recording_->decoder(message.connection(), reason);
    if (decoder == nullptr) return leaveOut(message, reason);
    const ByteView bytes = message.bytes();
    if (bytes.data == nullptr) return py::none();
    py::array_t<std::uint8_t> own(static_cast<py::ssize_t>(bytes.size));
    if (bytes.size > 0) std::memcpy(own.mutable_data(), bytes.data, bytes.size);
    try {
      return decoder->decode(own);
    } catch (const std::invalid_argument& error) {
      return leaveOut(message, error.what());
    } catch (const py::error_already_set&) {
      throw;
    } catch (const std::runtime_error& error) {
      urban_nav_input::throwDamaged(message.path() + ", topic " + message.topic(), error);
    }
  }

  /// Throws for a topic that was requested by name; otherwise warns once per topic that cannot be decoded.
  py::object leaveOut(const RecordedMessage& message, const std::string& reason) {
    const std::string text = "topic " + message.topic() + " cannot be decoded: " + reason;
    if (is_named_) throw urban_nav_core::DataError(message.path(), text, "raw=True, which returns the encoded bytes");
    if (std::find(warned_.begin(), warned_.end(), message.topic()) == warned_.end()) {
      warned_.push_back(message.topic());
      if (PyErr_WarnEx(PyExc_RuntimeWarning, (message.path() + ": " + text).c_str(), 1) != 0)
        throw py::error_already_set();
    }
    return py::none();
  }

  static py::object rawView(ByteView bytes) {
    const py::bytes own(reinterpret_cast<const char*>(bytes.data), bytes.size);
    PyObject* view = PyMemoryView_FromObject(own.ptr());
    if (view == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(view);
  }

  py::object yield(const RecordedMessage& message, const py::object& content) {
    const Connection& connection = message.connection();
    if (&connection != connection_) {
      topic_ = toText(connection.topic);
      connection_ = &connection;
    }
    return py::make_tuple(topic_, message.receipt(), content);
  }

  std::shared_ptr<OpenRecording> recording_;
  MessageSelection selection_;
  bool is_raw_, is_named_, is_sorted_;
  std::vector<RecordedMessage> all_;                    // if they are sorted
  std::vector<std::pair<StampNs, std::size_t>> order_;  // stamp and index in all_
  std::size_t next_ = 0;
  std::vector<std::string> warned_;
  const Connection* connection_ = nullptr;  // the last message's
  py::object topic_;
};

}  // namespace

PYBIND11_MODULE(_input, module) {
  module.doc() = "Reads recordings; the public class is urban_nav.Recording.";
  registerErrors();
  py::class_<MessageIterator>(module, "MessageIterator")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &MessageIterator::next);
  py::class_<OpenRecording, std::shared_ptr<OpenRecording>>(module, "OpenRecording")
      .def(py::init<const std::string&, py::function>(), py::arg("path"), py::arg("make_type"))
      .def("topics", &OpenRecording::topics)
      .def("start_ns", [](OpenRecording& self) { return self.recording().begin(); })
      .def("end_ns", [](OpenRecording& self) { return self.recording().end(); })
      .def("kind", [](OpenRecording& self) { return self.recording().kind(); })
      .def("warnings",
           [](OpenRecording& self) {
             py::list all;
             for (const std::string& warning : self.recording().warnings()) all.append(toText(warning));
             return all;
           })
      .def(
          "messages",
          [](std::shared_ptr<OpenRecording> self, std::optional<std::vector<std::string>> topics,
             std::optional<StampNs> begin, std::optional<StampNs> end, bool by_header, bool raw) {
            return std::make_unique<MessageIterator>(std::move(self),
                                                     Wishes{std::move(topics), begin, end, by_header, raw});
          },
          py::arg("topics"), py::arg("start_ns"), py::arg("end_ns"), py::arg("by_header"), py::arg("raw"));
}

}  // namespace urban_nav_python
