// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// State of a stage's output. Faults of the data are reported here, not as exceptions.
enum class Health {
  Ok,         ///< normal operation
  Degraded,   ///< output with reduced input; the covariance is larger accordingly
  Lost,       ///< output by prediction only; the covariance grows
  Recovered,  ///< the first good output after Lost
};

/// Returns "OK", "DEGRADED", "LOST" or "RECOVERED".
const char* toString(Health health);
/// Returns the value of a name of toString(); nullopt for any other word.
std::optional<Health> parseHealth(std::string_view text);
std::ostream& operator<<(std::ostream& out, Health health);

/// Health with its reason: an enumerator of the stage (0: none) and a message for users.
struct Status {
  Health health = Health::Ok;
  int reason = 0;
  std::string sentence;
};

bool operator==(const Status& a, const Status& b);
/// Prints "DEGRADED: 11 features, 20 wanted".
std::ostream& operator<<(std::ostream& out, const Status& status);

}  // namespace urban_nav_core
