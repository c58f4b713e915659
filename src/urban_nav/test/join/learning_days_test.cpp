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

TEST_F(JoinedDays, APlaceOfTwoDaysIsRecognisedAgainOnAThird) {
  makeThirdDay();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(runWords({"join", store("first"), store("again"), "-o", file("two.db")}), 0);
  EXPECT_EQ(::testing::internal::GetCapturedStderr().find("recognised again with"), std::string::npos)
      << "no session follows that could learn";
  EXPECT_FALSE(linkLines(file("two.db")).empty()) << "but a later run may have one";
  EXPECT_TRUE(linkLines(store("first")).empty()) << "nothing confirms places of one short session";
  EXPECT_GT(linkLines(store("three_days")).size(), linkLines(file("two.db")).size());
}

TEST_F(JoinedDays, ARunThatLearnsEndsWithTheSameBytesIfInterruptedOnAnyNumberOfThreads) {
  makeThirdDay();
  std::filesystem::create_directories(file("cut/summary.json/obstacle"));  // the last file: all else is done
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(mapThreeDays("cut", {"--threads", "1"}), 2);
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("places are recognised again with what"), std::string::npos) << log;
  std::filesystem::remove_all(file("cut/summary.json"));
  ASSERT_EQ(mapThreeDays("cut", {"--threads", "1"}), 0);
  EXPECT_EQ(differences("cut", "three_days"), std::vector<std::string>());
  EXPECT_EQ(linkLines(store("cut")), linkLines(store("three_days")));
}

TEST_F(JoinedDays, ThreeDaysLearnTheSameInAnyOrderAndWithOtherMaps) {
  makeThirdDay();
  ASSERT_EQ(map({file("third.bag")}, "third"), 0);
  ASSERT_EQ(runWords({"join", store("third"), store("second"), store("first"), store("again"), "-o", file("four.db")}),
            0);
  EXPECT_EQ(readStoreInfo(file("four.db")).joined.size(), 2U) << "the second part of the drive shows other places";
  EXPECT_EQ(linkLines(file("four.db")), linkLines(store("three_days")));
  ASSERT_EQ(map({file("third.bag")}, "continued", {"--store", store("days")}), 0);
  EXPECT_EQ(differences("continued", "three_days"), std::vector<std::string>());
  EXPECT_EQ(linkLines(store("continued")), linkLines(store("three_days")));
}

TEST_F(JoinedDays, ExportedPlacesHaveTheVerdictsOfGeometry) {
  ASSERT_EQ(runWords({"export", store("days"), "--places", file("places")}), 0);
  const auto places = urban_nav_core::CsvTable::read(file("places/places.csv"));
  const auto closures = urban_nav_core::CsvTable::read(file("days/closures.csv"));
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
  std::size_t exported = 0;
  for (const auto& [stamp, verdict] : verdicts) exported += verdict == "confirmed" ? 1 : 0;
  EXPECT_EQ(exported, confirmed.size());
}

}  // namespace
}  // namespace urban_nav
