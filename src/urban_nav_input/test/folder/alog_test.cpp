// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/alog.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::UserError;

const char* const kLog =
    "%%%%%%%%\n"
    "%% LOGSTART               1225719811.65\n"
    "-3.466          MISSION_FILE         Antler{Monarch} ANTLERFILTER:\n"
    "#begbroke - the door to the lab...\n"
    "AppTick = 30\n"
    "0: RELAYBOX_CMD\n"
    "\n"
    "61.59           DESIRED_THRUST       iJoystick  85.57 \r\n"
    "61.855          ODOMETRY_POSE        iPlatform  Pose=[3x1]{4.2216,18.5450,-0.7990},"
    "time=1225719873.5024,Speed=1.1025,Empty=[0]{},Tail=[2x2]{1,2,3,4,} \n"
    "61.963          DB_TIME              DB\n";

class AlogFile : public ::testing::Test {
 protected:
  void write(const std::string& text) { urban_nav_core::writeAtomically(path_, text); }
  void TearDown() override { std::filesystem::remove(path_); }
  std::vector<AlogRow> rows() {
    AlogReader reader(path_);
    std::vector<AlogRow> all;
    while (auto row = reader.next()) all.push_back(*row);
    start_ = reader.logStart();
    return all;
  }
  std::string error() {
    try {
      rows();
    } catch (const UserError& e) {
      return std::string(e.what()).substr(path_.size());
    }
    return "";
  }
  const std::string path_ =
      (std::filesystem::temp_directory_path() / ("alog_" + std::to_string(::getpid()) + ".alog")).string();
  std::optional<urban_nav_core::StampNs> start_;
};

TEST_F(AlogFile, SplitsRowsAndJoinsValuesOfSeveralLines) {
  write(kLog);
  const auto all = rows();
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(start_, 1225719811650000000);
  EXPECT_EQ(all[0].logged, -3466000000);
  EXPECT_EQ(all[0].variable, "MISSION_FILE");
  EXPECT_EQ(all[0].source, "Antler{Monarch}");
  EXPECT_EQ(all[0].value, "ANTLERFILTER:\n#begbroke - the door to the lab...\nAppTick = 30\n0: RELAYBOX_CMD\n");
  EXPECT_EQ(all[0].line, 3);
  EXPECT_EQ(all[1].value, "85.57");
  EXPECT_EQ(all[2].line, 9);
  EXPECT_EQ(all[3].source, "DB");
  EXPECT_EQ(all[3].value, "");
}

TEST_F(AlogFile, ALastLineWithoutAnEndCounts) {
  write("1.5 NAME source value");
  ASSERT_EQ(rows().size(), 1U);
  EXPECT_EQ(rows()[0].value, "value");
  write("");
  EXPECT_TRUE(rows().empty());
}

TEST_F(AlogFile, ALineLongerThanTheBufferIsWhole) {
  for (const std::size_t size : {65520U, 65535U, 65536U, 65537U, 200000U}) {
    write("1.5 NAME s " + std::string(size, 'x') + "\n2.5 NAME s y\n");
    const auto all = rows();
    ASSERT_EQ(all.size(), 2U) << size;
    EXPECT_EQ(all[0].value.size(), size);
    EXPECT_EQ(all[1].value, "y");
    EXPECT_EQ(all[1].line, 2);
  }
}

TEST_F(AlogFile, NamesFileAndLineOfWhatIsNoLog) {
  write("%% comment\nhello\n");
  EXPECT_EQ(error(),
            ":2: not a row of a MOOS log: expected `time VARIABLE source value`, or comments that begin with %%");
  write("%% LOGSTART soon\n");
  EXPECT_EQ(error(), ":1: LOGSTART without a time: expected Unix seconds");
  EXPECT_THROW(AlogReader("/nowhere/at/all.alog"), UserError);
}

TEST(AlogFields, ParsesNumbersStampsAndArrays) {
  const AlogFields fields(
      " Name=LISA, Sensor_0=LMS, Pose=[3x1]{4.2216,18.5450,-0.7990},time=1225719873.5024,"
      "Tail=[2x2]{1,2,3,4,},Empty=[0]{}",
      "a:1");
  EXPECT_EQ(fields.text("Name"), "LISA");
  EXPECT_EQ(fields.text("Sensor_0"), "LMS");
  EXPECT_EQ(fields.array("Pose", 3), (std::vector<double>{4.2216, 18.545, -0.799}));
  EXPECT_EQ(fields.stamp("time"), 1225719873502400000);
  EXPECT_EQ(fields.array("Tail"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_TRUE(fields.array("Empty").empty());
  EXPECT_TRUE(fields.has("Empty"));
  EXPECT_FALSE(fields.has("empty"));
}

TEST(AlogFields, RefusesDamagedValues) {
  const AlogFields fields("a=1.x,b=[3]{1,2},c=[2]{1,nan},d=[2]{1,2,e=[2x]{1,2}", "log:7");
  const auto error = [](const auto& call) {
    try {
      call();
    } catch (const UserError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error([&] { (void)fields.number("a"); }), "log:7: a = 1.x: expected a finite number");
  EXPECT_EQ(error([&] { (void)fields.number("z"); }), "log:7: no field `z`");
  EXPECT_EQ(error([&] { (void)fields.array("b"); }), "log:7: b: 2 numbers in [3]: expected [n]{v,v,...} or [rxc]{...}");
  EXPECT_NE(error([&] { (void)fields.array("c"); }), "");
  EXPECT_NE(error([&] { (void)fields.array("d"); }), "");
  EXPECT_NE(error([&] { (void)fields.stamp("a"); }), "");
  EXPECT_NE(error([&] { (void)AlogFields("b=[2]{1,2}", "log:7").array("b", 3); }), "");
}

TEST_F(AlogFile, Fuzzed) {
  const auto result = urban_nav_core::testing::fuzzFile({kLog}, "log.alog", [](const std::string& path) {
    AlogReader reader(path);
    while (const auto row = reader.next()) {
      const AlogFields fields(row->value, "here");
      if (fields.has("Pose")) (void)fields.array("Pose");
    }
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
}

}  // namespace
}  // namespace urban_nav_input
