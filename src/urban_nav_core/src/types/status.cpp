// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/status.hpp"

#include <cassert>
#include <ostream>

namespace urban_nav_core {

const char* toString(Health health) {
  switch (health) {
    case Health::Ok: return "OK";
    case Health::Degraded: return "DEGRADED";
    case Health::Lost: return "LOST";
    case Health::Recovered: return "RECOVERED";
  }
  assert(false && "a Health outside its enumeration");
  return "UNKNOWN";
}

std::optional<Health> parseHealth(std::string_view text) {
  for (const Health health : {Health::Ok, Health::Degraded, Health::Lost, Health::Recovered}) {
    if (text == toString(health)) return health;
  }
  return std::nullopt;
}

std::ostream& operator<<(std::ostream& out, Health health) { return out << toString(health); }

bool operator==(const Status& a, const Status& b) {
  return a.health == b.health && a.reason == b.reason && a.sentence == b.sentence;
}

std::ostream& operator<<(std::ostream& out, const Status& status) {
  out << status.health;
  if (!status.sentence.empty()) out << ": " << status.sentence;
  return out;
}

}  // namespace urban_nav_core
