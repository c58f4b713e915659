// SPDX-License-Identifier: BSD-3-Clause
#include "recording/message/transcoder.hpp"

#include <strings.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "urban_nav_input/recording/member_reader.hpp"

namespace urban_nav_input {

namespace {

constexpr std::size_t kEncapsulation = 4;  // bytes

bool haveSameName(const MessageField& a, const MessageField& b) {
  return strcasecmp(a.name.c_str(), b.name.c_str()) == 0;
}

}  // namespace

/// Conversion of one message.
class TranscoderRun {
 public:
  TranscoderRun(Transcoder& transcoder, ByteView in, MessageEncoding from, MessageEncoding to)
      : transcoder_(transcoder),
        out_(transcoder.out_),
        in_(in, from),
        swaps_(from == MessageEncoding::CdrBigEndian),
        writes_cdr_(to != MessageEncoding::Ros1) {
    out_.clear();
    out_.reserve(in.size + in.size / 8);
    if (writes_cdr_) out_ = {0, 1, 0, 0};
  }

  void copyMessage(std::size_t source, std::size_t target) {
    const Transcoder::Plan& plan = transcoder_.plan(source, target);
    in_.enter(transcoder_.source_.layouts[source]);
    for (const Transcoder::Step& step : plan) {
      if (step.source != nullptr && step.target != nullptr) copyField(*step.source, *step.target);
      else if (step.source != nullptr) skipField(*step.source);
      else writeDefault(*step.target);
    }
    if (writes_cdr_ && transcoder_.target_.layouts[target].fields.empty()) out_.push_back(0);
  }

 private:
  void alignOut(std::size_t size) {
    if (!writes_cdr_) return;
    const std::size_t beyond = (out_.size() - kEncapsulation) % size;
    if (beyond != 0) out_.resize(out_.size() + size - beyond, 0);
  }
  void putNumbers(ByteView numbers, std::size_t size) {
    if (numbers.size == 0) return;
    alignOut(size);
    const std::size_t begin = out_.size();
    out_.insert(out_.end(), numbers.data, numbers.data + numbers.size);
    if (!swaps_ || size == 1) return;
    for (std::size_t i = begin; i < out_.size(); i += size)
      std::reverse(out_.begin() + static_cast<std::ptrdiff_t>(i), out_.begin() + static_cast<std::ptrdiff_t>(i + size));
  }
  void putCount(std::size_t count) {
    const auto number = static_cast<std::uint32_t>(count);
    std::uint8_t bytes[sizeof(number)];
    std::memcpy(bytes, &number, sizeof(number));
    alignOut(sizeof(number));
    out_.insert(out_.end(), bytes, bytes + sizeof(number));
  }

  void putText(ByteView text) {
    putCount(text.size + (writes_cdr_ ? 1 : 0));
    out_.insert(out_.end(), text.data, text.data + text.size);
    if (writes_cdr_) out_.push_back(0);
  }

  void copyField(const MessageField& source, const MessageField& target) {
    const std::size_t count = in_.count(source);
    if (target.array == MessageField::Array::Sequence) putCount(count);
    switch (source.kind) {
      case FieldKind::Text:
        for (std::size_t i = 0; i < count; ++i) putText(in_.text());
        return;
      case FieldKind::Message:
        for (std::size_t i = 0; i < count; ++i) copyMessage(source.layout, target.layout);
        return;
      case FieldKind::Time: putNumbers(in_.numbers(2 * count, 4), 4); return;
      default: putNumbers(in_.numbers(count, numberSize(source.kind)), numberSize(source.kind));
    }
  }

  void skipField(const MessageField& field) {
    const std::size_t count = in_.count(field);
    switch (field.kind) {
      case FieldKind::Text:
        for (std::size_t i = 0; i < count; ++i) in_.text();
        return;
      case FieldKind::Message:
        for (std::size_t i = 0; i < count; ++i) {
          const MessageLayout& layout = transcoder_.source_.layouts[field.layout];
          in_.enter(layout);
          for (const MessageField& member : layout.fields) skipField(member);
        }
        return;
      case FieldKind::Time: in_.numbers(2 * count, 4); return;
      default: in_.numbers(count, numberSize(field.kind));
    }
  }

  void writeDefault(const MessageField& field) {
    if (field.array == MessageField::Array::Sequence) return putCount(0);
    static constexpr std::uint8_t kZeros[8] = {};
    for (std::size_t i = 0; i < field.count; ++i) {
      switch (field.kind) {
        case FieldKind::Text: putText({}); break;
        case FieldKind::Time: putNumbers({kZeros, 8}, 4); break;
        case FieldKind::Message: {
          const MessageLayout& layout = transcoder_.target_.layouts[field.layout];
          if (writes_cdr_ && layout.fields.empty()) out_.push_back(0);
          for (const MessageField& member : layout.fields) writeDefault(member);
          break;
        }
        default: putNumbers({kZeros, numberSize(field.kind)}, numberSize(field.kind));
      }
    }
  }

  Transcoder& transcoder_;
  std::vector<std::uint8_t>& out_;
  MemberReader in_;
  bool swaps_, writes_cdr_;
};

Transcoder::Transcoder(MessageDefinition source, MessageDefinition target)
    : source_(std::move(source)), target_(std::move(target)) {
  plan(0, 0);
}

const Transcoder::Plan& Transcoder::plan(std::size_t source, std::size_t target) {
  const auto [known, is_new] = plans_.try_emplace({source, target});
  Plan& steps = known->second;
  if (!is_new) return steps;
  const std::vector<MessageField>& from = source_.layouts[source].fields;
  const std::vector<MessageField>& to = target_.layouts[target].fields;
  const std::string& type = source_.layouts[source].type;
  const bool is_header = target_.layouts[target].type == "std_msgs/Header";
  std::size_t next = 0;
  for (const MessageField& field : to) {
    const auto found =
        std::find_if(from.begin(), from.end(), [&](const MessageField& f) { return haveSameName(f, field); });
    if (found == from.end()) {
      steps.push_back({nullptr, &field});
      is_same_ = is_same_ && is_header && field.name == "seq";
      continue;
    }
    const auto place = static_cast<std::size_t>(found - from.begin());
    if (place < next) throw std::invalid_argument("members of " + type + " are in another order");
    for (; next < place; ++next) {
      steps.push_back({&from[next], nullptr});
      is_same_ = false;
    }
    steps.push_back({&from[next++], &field});
  }
  for (; next < from.size(); ++next) {
    steps.push_back({&from[next], nullptr});
    is_same_ = false;
  }
  is_same_ = is_same_ && !(from.empty() && source_.layouts.size() > 1);
  const Plan copy = steps;
  for (const Step& step : copy) checkStep(type, step);
  return plans_.at({source, target});
}

void Transcoder::checkStep(const std::string& type, const Step& step) {
  if (step.source == nullptr || step.target == nullptr) return;
  const bool have_same_size = step.source->array == step.target->array && step.source->count == step.target->count;
  if (step.source->kind != step.target->kind || !have_same_size)
    throw std::invalid_argument("member " + step.source->name + " of " + type + " is of another type");
  if (step.source->kind == FieldKind::Message) plan(step.source->layout, step.target->layout);
}

ByteView Transcoder::convert(ByteView bytes, MessageEncoding from, MessageEncoding to) {
  TranscoderRun run(*this, bytes, from, to);
  run.copyMessage(0, 0);
  return {out_.data(), out_.size()};
}

}  // namespace urban_nav_input
