// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// What a stage says of its own trustworthiness, for each output. Failure of data is one of these, not an exception.
enum class Health {
  Ok,         ///< works as designed
  Degraded,   ///< answers, with less to go on than it should have; the covariance says how much less
  Lost,       ///< answers by prediction alone; the covariance grows
  Recovered,  ///< the first good output after Lost
};

/// "OK", "DEGRADED", "LOST", "RECOVERED".
const char* toString(Health health);
/// The inverse of toString; empty for any other word.
std::optional<Health> parseHealth(std::string_view text);
std::ostream& operator<<(std::ostream& out, Health health);

/// Health with its reason: an enumerator of the stage (0: none) and a sentence for a person.
struct Status {
  Health health = Health::Ok;
  int reason = 0;
  std::string sentence;
};

bool operator==(const Status& a, const Status& b);
/// "DEGRADED: 11 features, 20 wanted".
std::ostream& operator<<(std::ostream& out, const Status& status);

}  // namespace urban_nav_core
