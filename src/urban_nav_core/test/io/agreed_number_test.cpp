// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/agreed_number.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <thread>
#include <vector>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

class AgreedNumber : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder); }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("agreed_number_" + std::to_string(::getpid()));
  const std::string file = (folder / "new" / "begin").string();
};

TEST_F(AgreedNumber, TheFirstProposalHoldsForAll) {
  EXPECT_EQ(agreeOnNumber(file, 3'000'000'000), 3'000'000'000);
  EXPECT_EQ(agreeOnNumber(file, 1), 3'000'000'000);
  EXPECT_EQ(agreeOnNumber(file, -60'000'000'000), 3'000'000'000);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1) << "no proposal is left";
}

TEST_F(AgreedNumber, IsFoundOnceItIsWritten) {
  EXPECT_EQ(findAgreedNumber(file), std::nullopt);
  EXPECT_FALSE(std::filesystem::exists(folder)) << "a lookup creates no folder";
  agreeOnNumber(file, 7);
  EXPECT_EQ(findAgreedNumber(file), 7);
  EXPECT_EQ(agreeOnNumber(file, 1), 7);
}

TEST_F(AgreedNumber, ThreadsOfOneProcessAgree) {
  std::vector<std::int64_t> agreed(16);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < agreed.size(); ++i)
    threads.emplace_back([&, i] { agreed[i] = agreeOnNumber(file, 100 + static_cast<std::int64_t>(i)); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::set<std::int64_t>(agreed.begin(), agreed.end()).size(), 1U);
  EXPECT_GE(agreed.front(), 100);
  EXPECT_LT(agreed.front(), 116);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1) << "no proposal is left";
}

TEST_F(AgreedNumber, AFileOfSomethingElseIsRefused) {
  std::filesystem::create_directories(folder / "new");
  std::ofstream(file) << "soon";
  EXPECT_THROW(agreeOnNumber(file, 1), UserError);
  EXPECT_THROW(findAgreedNumber(file), UserError);
}

TEST_F(AgreedNumber, AFolderThatCannotBeMadeIsNamed) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "new") << "a file where the folder should be";
  EXPECT_THROW(agreeOnNumber(file, 1), UserError);
}

}  // namespace
}  // namespace urban_nav_core
