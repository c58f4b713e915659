// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "loop_metric/evidence.hpp"

namespace loop_metric {

/// Returns the value and the limit of a test: "matches = 51 (>= 50)".
std::string describe(const urban_nav_registration::ClosureTest& test);

/// Returns the test by which a closure was nearest to the opposite result; nullopt without tests. Nearness is the
/// difference of value and limit relative to the larger of both. Of an accepted closure, the passed test nearest to
/// failing; of a rejected one, the failed test nearest to passing, or without a failed test the passed one nearest to
/// failing.
std::optional<urban_nav_registration::ClosureTest> nearestTest(const Evidence& evidence);

/// Returns the heading of try number `number` (from 0): "Two views (1 of 2 tries)".
std::string tryTitle(const Evidence& evidence, std::size_t number);

/// Heading of the tests against odometry and neighbouring closures.
constexpr const char* kGateTitle = "Against odometry and its neighbours";

/// Returns all tries with their tests and the tests of the gate, one line each, indented by two blanks; empty without
/// evidence.
std::string describe(const Evidence& evidence);

}  // namespace loop_metric
