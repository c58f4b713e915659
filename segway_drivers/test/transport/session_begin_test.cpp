// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/transport/session_begin.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {
namespace {

class SessionBegin : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder); }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("session_begin_" + std::to_string(::getpid()));
  const std::string file = (folder / "new" / "begin").string();
};

TEST_F(SessionBegin, TheFirstDeviceDecidesForAll) {
  const TimeNs before = steadyTime(), begin = agreeOnBegin(file, 3'000'000'000);
  EXPECT_GE(begin, before + 3'000'000'000);
  EXPECT_EQ(agreeOnBegin(file, 3'000'000'000), begin);
  EXPECT_EQ(agreeOnBegin(file, 60'000'000'000), begin);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1) << "no proposal is left";
}

TEST_F(SessionBegin, AFileOfSomethingElseIsRefused) {
  std::filesystem::create_directories(folder / "new");
  std::ofstream(file) << "soon";
  EXPECT_THROW(agreeOnBegin(file, 1), urban_nav_core::UserError);
}

}  // namespace
}  // namespace segway_drivers
