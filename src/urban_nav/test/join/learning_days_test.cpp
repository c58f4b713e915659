// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "joined_days.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/place_link.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::readFile;
using urban_nav_store::PlaceLink;

/// Returns the links of a store, a line each.
std::set<std::string> linkLines(const std::string& path) {
  urban_nav_store::Store store(path, urban_nav_store::Access::Read);
  std::set<std::string> lines;
  for (const urban_nav_store::Session& session : store.sessions().all())
    urban_nav_store::TableStore<PlaceLink>(store).forEach(session.id, [&](const PlaceLink& link) {
      lines.insert(link.session + " " + std::to_string(link.stamp) + " " + link.earlier + " " +
                   std::to_string(link.earlier_stamp) + " " + std::to_string(link.accepted));
    });
  return lines;
}

/// Returns the rows of a table with a value in a column.
std::size_t countRows(const urban_nav_core::CsvTable& table, const char* column, const std::string& value) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) count += table.text(row, table.column(column)) == value ? 1 : 0;
  return count;
}

/// Three days at one place: the third is recognised with what the second was confirmed to show.
class LearningDays : public JoinedDays {
 protected:
  static void SetUpTestSuite() {
    JoinedDays::SetUpTestSuite();
    testing::cutSharedDrive(file("third.bag"), {0.0, 6.0, {"/stereo/", "/ladybug/", "/laser_", "/imu/"}, "", 2});
    ASSERT_EQ(mapDays("learnt", {"--threads", "2"}), 0);
  }
  static int mapDays(const std::string& out, const std::vector<std::string>& options = {}) {
    return map({file("first.bag"), file("again.bag"), file("third.bag")}, out, options);
  }
};

TEST_F(LearningDays, PlacesOfThreeDaysAreRecognisedAgain) {
  ::testing::internal::CaptureStderr();
  ASSERT_EQ(mapDays("again_learnt"), 0);
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("places are recognised again with what"), std::string::npos) << log;
  EXPECT_FALSE(linkLines(store("learnt")).empty());
  EXPECT_TRUE(linkLines(store("first")).empty()) << "nothing confirms places of one short session";
}

TEST_F(LearningDays, AnInterruptedRunEndsWithTheSameBytesOnAnyNumberOfThreads) {
  std::filesystem::create_directories(file("cut/summary.json/in the way"));  // the last file: all else is done
  EXPECT_EQ(mapDays("cut", {"--threads", "1"}), 2);
  std::filesystem::remove_all(file("cut/summary.json"));
  ASSERT_EQ(mapDays("cut", {"--threads", "1"}), 0);
  EXPECT_EQ(differences("cut", "learnt"), std::vector<std::string>());
  EXPECT_EQ(linkLines(store("cut")), linkLines(store("learnt")));
}

TEST_F(LearningDays, StoresInAnyOrderLearnTheSame) {
  ASSERT_EQ(map({file("third.bag")}, "third"), 0);
  ASSERT_EQ(runWords({"join", store("third"), store("first"), store("again"), "-o", file("joined.db")}), 0);
  ASSERT_EQ(runWords({"export", file("joined.db"), "--results", file("joined")}), 0);
  EXPECT_EQ(differences("joined", "learnt"), std::vector<std::string>());
  EXPECT_EQ(linkLines(file("joined.db")), linkLines(store("learnt")));
  ASSERT_EQ(map({file("third.bag")}, "continued", {"--store", store("days")}), 0);
  EXPECT_EQ(differences("continued", "learnt"), std::vector<std::string>());
}

TEST_F(LearningDays, TheirMapDoesNotDependOnSessionsElsewhere) {
  ASSERT_EQ(map({file("first.bag"), file("second.bag"), file("again.bag"), file("third.bag")}, "four"), 0);
  const StoreInfo info = readStoreInfo(store("four"));
  ASSERT_EQ(info.joined.size(), 2U) << "the second part of the drive shows other places";
  EXPECT_EQ(linkLines(store("four")), linkLines(store("learnt")));
}

TEST_F(LearningDays, ExportedPlacesHaveTheVerdictsOfGeometry) {
  ASSERT_EQ(runWords({"export", store("learnt"), "--places", file("places")}), 0);
  const auto places = urban_nav_core::CsvTable::read(file("places/places.csv"));
  const auto closures = urban_nav_core::CsvTable::read(file("learnt/closures.csv"));
  std::map<std::string, std::string> verdicts;  // by stamp
  for (std::size_t row = 0; row < places.rows(); ++row)
    verdicts[places.text(row, places.column("stamp_ns"))] = places.text(row, places.column("verdict"));
  std::set<std::string> confirmed, candidates;  // stamps of later poses
  for (std::size_t row = 0; row < closures.rows(); ++row) {
    const std::string stamp = closures.text(row, closures.column("stamp_b_ns"));
    candidates.insert(stamp);
    if (closures.text(row, closures.column("verdict")) == "accepted") confirmed.insert(stamp);
  }
  EXPECT_FALSE(confirmed.empty());
  for (const auto& [stamp, verdict] : verdicts) {
    if (confirmed.count(stamp) != 0) EXPECT_EQ(verdict, "confirmed") << stamp;
    else if (candidates.count(stamp) == 0) EXPECT_EQ(verdict, "") << stamp;
    else EXPECT_TRUE(verdict.empty() || verdict == "rejected" || verdict == "withdrawn" || verdict == "accepted");
  }
  EXPECT_EQ(countRows(places, "verdict", "confirmed"), confirmed.size());
}

}  // namespace
}  // namespace urban_nav
