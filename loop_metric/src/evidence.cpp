// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::CsvTable;
using urban_nav_core::Pose;
using urban_nav_core::printNumber;
using urban_nav_registration::Alignment;
using urban_nav_registration::AlignmentTest;
using urban_nav_registration::ClosureTest;
using urban_nav_registration::MatchedPixels;
using urban_nav_registration::StereoClosure;

namespace {

constexpr std::size_t kMostPixels = 100;
// One header for all kinds of lines, so that any program can read the table; unused columns are empty.
constexpr const char* kHeader =
    "kind,name,value,threshold,at_least,passed,session_a,stamp_a_ns,session_b,stamp_b_ns,text\n";
constexpr std::size_t kColumns = 11;

using Cells = std::vector<std::string>;

/// Replaces infinite and undefined numbers by finite ones.
std::string cell(double value) { return printNumber(std::clamp(value == value ? value : 1e300, -1e300, 1e300)); }

void print(std::string& text, Cells cells) {
  cells.resize(kColumns);
  text += urban_nav_core::printCsvRow(cells);
}

void print(std::string& text, const ClosureTest& test, const char* kind) {
  print(text,
        {kind, test.name, cell(test.value), cell(test.threshold), test.at_least ? "1" : "0", test.passed ? "1" : "0"});
}

void print(std::string& text, const char* name, const Pose& T) {
  std::string words;
  for (const double number : {T.t().x(), T.t().y(), T.t().z(), T.q().x(), T.q().y(), T.q().z(), T.q().w()})
    words += (words.empty() ? "" : " ") + printNumber(number);
  print(text, {"transform", name, "", "", "", "", "", "", "", "", words});
}

Evidence::Try toTry(const StereoAttempt& made) {
  const StereoClosure& result = made.result;
  Evidence::Try its;
  its.method = ClosureMethod::Stereo;
  its.keyframe_a = made.keyframe_a.at;
  its.keyframe_b = made.keyframe_b.at;
  its.verdict = result.verdict;
  its.reason = toString(result.reason);
  its.sentence = result.sentence;
  its.tests = result.tests;
  const std::size_t step = 1 + result.pixels.size() / kMostPixels;
  for (std::size_t i = 0; i < result.pixels.size(); i += step) its.pixels.push_back(result.pixels[i]);
  return its;
}

Evidence::Try toTry(const Alignment& alignment, const CandidateMeasurement& measurement) {
  Evidence::Try its;
  its.method = ClosureMethod::Icp;
  its.keyframe_a = measurement.metric.a;
  its.keyframe_b = measurement.metric.b;
  its.verdict = alignment.verdict;
  its.reason = toString(alignment.reason);
  its.sentence = alignment.sentence;
  its.guess = measurement.attempts.icp_guess;
  its.T_a_b = alignment.T_target_source;
  for (const AlignmentTest& test : alignment.tests)
    its.tests.push_back({test.name, test.value, test.threshold, test.at_least, test.passed});
  return its;
}

class Reader {
 public:
  explicit Reader(std::string_view text) : table_(CsvTable::parse(text, "evidence")) {
    if (table_.header().size() != kColumns) refuse(0, "unexpected columns");
  }

  Evidence read() {
    Evidence evidence;
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      const std::string& kind = table_.text(row, 0);
      if (kind == "try") {
        Evidence::Try begun;
        begun.method = methodAt(row);
        begun.keyframe_a = {table_.text(row, 6), table_.integer(row, 7)};
        begun.keyframe_b = {table_.text(row, 8), table_.integer(row, 9)};
        evidence.tries.push_back(begun);
      } else if (kind == "gate") {
        evidence.gate.push_back(testAt(row));
      } else if (evidence.tries.empty()) {
        refuse(row, "line of a try before its first line");
      } else if (kind == "verdict") {
        Evidence::Try& last = evidence.tries.back();
        last.verdict = verdictAt(row);
        last.reason = table_.text(row, 6);
        last.sentence = table_.text(row, 10);
      } else if (kind == "test") {
        evidence.tries.back().tests.push_back(testAt(row));
      } else if (kind == "transform") {
        Evidence::Try& last = evidence.tries.back();
        (table_.text(row, 1) == "guess" ? last.guess : last.T_a_b) = poseAt(row);
      } else if (kind == "pixels") {
        evidence.tries.back().pixels.push_back(pixelsAt(row));
      } else {
        refuse(row, "unknown kind of line");
      }
    }
    return evidence;
  }

 private:
  bool yes(std::size_t row, std::size_t column) const {
    const std::int64_t value = table_.integer(row, column);
    if (value != 0 && value != 1) refuse(row, "expected 0 or 1");
    return value == 1;
  }
  ClosureMethod methodAt(std::size_t row) const {
    const auto method = urban_nav_core::parseClosureMethod(table_.text(row, 1));
    if (!method || *method == ClosureMethod::None) refuse(row, "invalid method");
    return *method;
  }
  urban_nav_core::ClosureVerdict verdictAt(std::size_t row) const {
    const auto verdict = urban_nav_core::parseClosureVerdict(table_.text(row, 1));
    if (!verdict) refuse(row, "invalid verdict");
    return *verdict;
  }
  ClosureTest testAt(std::size_t row) const {
    return {table_.text(row, 1), table_.number(row, 2), table_.number(row, 3), yes(row, 4), yes(row, 5)};
  }
  Pose poseAt(std::size_t row) const {
    std::array<double, 7> numbers{};  // x y z, qx qy qz qw
    std::size_t count = 0;
    for (const std::string_view word : urban_nav_core::splitBlanks(table_.text(row, 10))) {
      const auto number = urban_nav_core::parseNumber(word);
      if (!number || count == numbers.size()) refuse(row, "invalid transform");
      numbers[count++] = *number;
    }
    const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
    if (count != numbers.size() || !(std::abs(q.norm() - 1.0) < 1e-6)) refuse(row, "invalid transform");
    return Pose(q.normalized(), {numbers[0], numbers[1], numbers[2]});
  }
  MatchedPixels pixelsAt(std::size_t row) const {
    MatchedPixels pixels;
    pixels.in_a = {table_.number(row, 2), table_.number(row, 3)};
    pixels.in_b = {table_.number(row, 6), table_.number(row, 8)};
    pixels.residual_px = table_.number(row, 10);
    pixels.inlier = yes(row, 5);
    return pixels;
  }
  [[noreturn]] void refuse(std::size_t row, const char* found) const {
    throw urban_nav_core::DataError(table_.rows() > row ? table_.where(row) : "evidence", found, "");
  }

  CsvTable table_;
};

}  // namespace

Evidence collectEvidence(const CandidateMeasurement& measurement) {
  const RegistrationAttempts& attempts = measurement.attempts;
  Evidence evidence;
  for (const StereoAttempt& made : attempts.stereo) evidence.tries.push_back(toTry(made));
  if (attempts.icp) evidence.tries.push_back(toTry(*attempts.icp, measurement));
  evidence.gate = attempts.tests;
  return evidence;
}

std::string printEvidence(const Evidence& evidence) {
  std::string text = kHeader;
  for (const Evidence::Try& each : evidence.tries) {
    print(text,
          {"try", toString(each.method), "", "", "", "", each.keyframe_a.session, std::to_string(each.keyframe_a.stamp),
           each.keyframe_b.session, std::to_string(each.keyframe_b.stamp)});
    print(text, {"verdict", toString(each.verdict), "", "", "", "", each.reason, "", "", "", each.sentence});
    for (const ClosureTest& test : each.tests) print(text, test, "test");
    if (each.guess) print(text, "guess", *each.guess);
    if (each.T_a_b) print(text, "T_a_b", *each.T_a_b);
    for (const MatchedPixels& pixels : each.pixels)
      print(text, {"pixels", "", cell(pixels.in_a.x()), cell(pixels.in_a.y()), "", pixels.inlier ? "1" : "0",
                   cell(pixels.in_b.x()), "", cell(pixels.in_b.y()), "", cell(pixels.residual_px)});
  }
  for (const ClosureTest& test : evidence.gate) print(text, test, "gate");
  return text;
}

Evidence parseEvidence(std::string_view text) {
  try {
    return Reader(text).read();
  } catch (const urban_nav_core::UserError& error) {  // evidence is written by a program, so damage is a data error
    throw urban_nav_core::DataError(error.parts());
  }
}

std::string_view evidenceIn(std::string_view text) {
  const std::string_view begin = kHeader;
  if (text.substr(0, begin.size()) == begin) return text;
  const std::size_t place = text.find("\n" + std::string(begin));
  return place == std::string_view::npos ? std::string_view() : text.substr(place + 1);
}

}  // namespace loop_metric
