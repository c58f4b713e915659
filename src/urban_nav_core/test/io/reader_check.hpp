// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

/// The text of the UserError that a call throws, or "".
template <typename Call>
std::string catchError(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Checks that a reader accepts some damaged files and rejects others, without other errors.
inline void expectSurvives(const testing::FuzzResult& result) {
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace urban_nav_core
