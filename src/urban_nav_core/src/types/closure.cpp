// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/closure.hpp"

#include <cassert>
#include <ostream>
#include <tuple>

#include "urban_nav_core/types/graph_update.hpp"

namespace urban_nav_core {
namespace {

template <typename Enumerator>
std::optional<Enumerator> parse(std::string_view word, std::initializer_list<Enumerator> all) {
  for (const Enumerator value : all) {
    if (word == toString(value)) return value;
  }
  return std::nullopt;
}

}  // namespace

bool operator==(const PoseRef& a, const PoseRef& b) { return a.session == b.session && a.stamp == b.stamp; }
bool operator<(const PoseRef& a, const PoseRef& b) {
  return std::tie(a.session, a.stamp) < std::tie(b.session, b.stamp);
}
std::ostream& operator<<(std::ostream& out, const PoseRef& ref) {
  if (!ref.session.empty()) out << ref.session << ' ';
  return out << printStamp(ref.stamp) << " s";
}

const char* toString(ClosureMethod method) {
  switch (method) {
    case ClosureMethod::None: return "none";
    case ClosureMethod::Stereo: return "stereo";
    case ClosureMethod::Icp: return "icp";
  }
  assert(false && "a ClosureMethod outside its enumeration");
  return "unknown";
}
std::optional<ClosureMethod> parseClosureMethod(std::string_view word) {
  return parse(word, {ClosureMethod::None, ClosureMethod::Stereo, ClosureMethod::Icp});
}

const char* toString(ClosureVerdict verdict) {
  switch (verdict) {
    case ClosureVerdict::Accepted: return "accepted";
    case ClosureVerdict::Rejected: return "rejected";
    case ClosureVerdict::Waiting: return "waiting";
    case ClosureVerdict::Degenerate: return "degenerate";
  }
  assert(false && "a ClosureVerdict outside its enumeration");
  return "unknown";
}
std::optional<ClosureVerdict> parseClosureVerdict(std::string_view word) {
  return parse(
      word, {ClosureVerdict::Accepted, ClosureVerdict::Rejected, ClosureVerdict::Waiting, ClosureVerdict::Degenerate});
}

bool operator==(const EdgeRef& a, const EdgeRef& b) {
  return a.a == b.a && a.b == b.b && a.kind == b.kind && a.source == b.source;
}

}  // namespace urban_nav_core
