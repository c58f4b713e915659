// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_places.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "support/square_images.hpp"
#include "support/temporary_folder.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace fabmap_node {
namespace {

using testing::drawSquares;
using testing::TemporaryFolder;
using urban_nav_core::StampNs;
using urban_nav_store::Access;
using urban_nav_store::Session;
using urban_nav_store::Store;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

constexpr StampNs kObservationPeriod = 1'000'000'000, kMonday = 1'225'719'873 * kObservationPeriod,
                  kTuesday = kMonday + 86'400 * kObservationPeriod;

class LivePlacesTest : public ::testing::Test {
 protected:
  /// Process that writes to a store, or to none.
  std::unique_ptr<LivePlaces> begin(const std::string& store, bool is_announced = false) {
    urban_nav_live::StoreWriterLink::Options options;
    options.now = [this] { return now_; };
    auto places =
        std::make_unique<LivePlaces>(Parameters(), LiveSessionName{"lisa", "begbroke", is_announced}, store, options);
    places->syncStore();
    return places;
  }
  /// Drive past places, one per kObservationPeriod, with odometry.
  static void drive(LivePlaces& places, StampNs start, unsigned from, unsigned to) {
    for (unsigned i = from; i < to; ++i) {
      const StampNs stamp = start + (i - from) * kObservationPeriod;
      places.addOdometry({stamp, {urban_nav_core::Quaterniond::Identity(), {2.0 * (i - from), 0.0, 0.0}}});
      observe(places, stamp, i);
      places.syncStore();
    }
  }
  static PlaceOutput observe(LivePlaces& places, StampNs stamp, unsigned place) {
    const cv::Mat image = drawSquares(place, 0);
    return places.process(stamp, {{image.data, image.cols, image.rows, image.cols}});
  }
  /// Advances the clock of the store by an hour.
  void wait() { now_ += std::chrono::hours(1); }

  static std::vector<Session> sessions(const std::string& path) { return Store(path, Access::Read).sessions().all(); }
  static std::vector<StoredPlace> rows(const std::string& path, const std::string& session) {
    Store store(path, Access::Read);
    std::vector<StoredPlace> rows;
    TableStore<StoredPlace>(store).forEach(session, [&](const StoredPlace& row) { rows.push_back(row); });
    return rows;
  }
  static std::string readContent(const std::string& path) {
    Store store(path, Access::Read);
    return urban_nav_store::dump(store);
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_.file("places.db");
  urban_nav_live::StoreWriterLink::Clock::time_point now_{};
};

TEST_F(LivePlacesTest, StoresPlacesWhileTheyAreObserved) {
  const auto places = begin(path_);
  drive(*places, kMonday, 0, 4);
  EXPECT_NE(places->save(path_).find("committed"), std::string::npos);
  const std::vector<Session> stored = sessions(path_);
  ASSERT_EQ(stored.size(), 1u);
  EXPECT_EQ(stored[0].start, kMonday);
  EXPECT_EQ(stored[0].robot, "lisa");
  EXPECT_EQ(stored[0].recording, "begbroke");
  EXPECT_FALSE(stored[0].complete);
  const std::vector<StoredPlace> read = rows(path_, stored[0].id);
  ASSERT_EQ(read.size(), 4u);
  EXPECT_EQ(read[3].stamp, kMonday + 3 * kObservationPeriod);
  EXPECT_FALSE(read[3].thumbnail.empty());
}

TEST_F(LivePlacesTest, RecognisesPlacesOfAnEarlierProcess) {
  drive(*begin(path_), kMonday, 0, 4);
  const std::vector<Session> stored = sessions(path_);
  ASSERT_EQ(stored.size(), 1u);
  EXPECT_TRUE(stored[0].complete);
  const auto places = begin(path_);
  drive(*places, kTuesday, 4, 6);
  const PlaceOutput output = observe(*places, kTuesday + 10 * kObservationPeriod, 2);
  ASSERT_FALSE(output.belief.likeliest.empty());
  EXPECT_EQ(output.belief.likeliest[0].at.session, stored[0].id);
  EXPECT_EQ(output.belief.likeliest[0].at.stamp, kMonday + 2 * kObservationPeriod);
}

TEST_F(LivePlacesTest, ARecordingThatIsPlayedAgainGivesTheSameContent) {
  const std::string whole = folder_.file("whole.db");
  drive(*begin(whole), kMonday, 0, 6);
  drive(*begin(path_), kMonday, 0, 3);
  {
    const auto places = begin(path_);
    drive(*places, kMonday, 0, 1);
    EXPECT_TRUE(observe(*places, kMonday + kObservationPeriod, 1).belief.likeliest.empty())
        << "places observed later are not candidates";
    drive(*places, kMonday + 2 * kObservationPeriod, 2, 6);
  }
  EXPECT_EQ(sessions(path_).size(), 1u);
  EXPECT_EQ(readContent(path_), readContent(whole));
}

TEST_F(LivePlacesTest, VerdictsChangeTheBeliefOfTheSessionOnly) {
  drive(*begin(path_), kMonday, 0, 8);
  const std::string monday = sessions(path_).at(0).id;
  const auto places = begin(path_);
  drive(*places, kTuesday, 20, 25);
  const StampNs seen = kTuesday + 5 * kObservationPeriod;
  places->addOdometry({seen, {urban_nav_core::Quaterniond::Identity(), {10.0, 0.0, 0.0}}});
  const PlaceOutput output = observe(*places, seen, 3);
  ASSERT_FALSE(output.belief.likeliest.empty());
  const urban_nav_core::PoseRef a = output.belief.likeliest[0].at;
  ASSERT_EQ(a.session, monday);
  const double before = output.belief.likeliest[0].probability;
  urban_nav_core::MetricClosure closure;
  closure.a = a;
  closure.b = {"", seen + 20'000'000};  // verdicts name the nearest frame of odometry
  closure.source = "loop_metric";
  /// Returns the probability of the place at `seen` after the verdict; -1 if that belief does not change.
  const auto probabilityAfter = [&](urban_nav_core::ClosureVerdict verdict) {
    closure.verdict = verdict;
    for (const PlaceBelief& belief : places->addVerdict(closure))
      if (belief.at.stamp == seen) return belief.likeliest.at(0).probability;
    return -1.0;
  };
  const double rejected = probabilityAfter(urban_nav_core::ClosureVerdict::Rejected);
  EXPECT_GE(rejected, 0.0);
  EXPECT_LT(rejected, before);
  const double accepted = probabilityAfter(urban_nav_core::ClosureVerdict::Accepted);
  EXPECT_GT(accepted, before);
  closure.source = "pose_graph";
  EXPECT_LT(probabilityAfter(urban_nav_core::ClosureVerdict::Rejected), before);
  closure.a.session = "unknown";
  EXPECT_EQ(probabilityAfter(urban_nav_core::ClosureVerdict::Accepted), -1.0);
  closure.a = a;
  closure.b = {monday, a.stamp};
  EXPECT_EQ(probabilityAfter(urban_nav_core::ClosureVerdict::Accepted), -1.0) << "of an earlier session";
  closure.b = {"", seen};
  places->reset();
  EXPECT_EQ(probabilityAfter(urban_nav_core::ClosureVerdict::Accepted), -1.0);
}

/// Returns an accepted closure of both drives at a place, 1 s apart.
urban_nav_core::MetricClosure acceptedClosure(const std::string& a, StampNs stamp_a, StampNs stamp_b) {
  urban_nav_core::MetricClosure closure;
  closure.a = {a, stamp_a};
  closure.b = {"", stamp_b};
  closure.verdict = urban_nav_core::ClosureVerdict::Accepted;
  closure.source = "loop_metric";
  return closure;
}

TEST_F(LivePlacesTest, WhatIsLearntIsStoredAndKnownAfterARestart) {
  drive(*begin(path_), kMonday, 0, 8);
  const std::string monday = sessions(path_).at(0).id;
  {
    const auto places = begin(path_);
    drive(*places, kTuesday, 0, 8);
    for (unsigned i = 0; i < 8; ++i)
      places->addVerdict(acceptedClosure(monday, kMonday + i * kObservationPeriod, kTuesday + i * kObservationPeriod));
    places->commit();
  }
  ASSERT_EQ(sessions(path_).size(), 2u);
  const std::string tuesday = sessions(path_).at(1).id;
  std::vector<urban_nav_store::PlaceLink> links;
  {
    Store store(path_, Access::Read);
    TableStore<urban_nav_store::PlaceLink>(store).forEach(
        tuesday, [&](const urban_nav_store::PlaceLink& link) { links.push_back(link); });
  }
  ASSERT_EQ(links.size(), 8u);
  EXPECT_EQ(links[3].earlier, monday);
  EXPECT_EQ(links[3].earlier_stamp, kMonday + 3 * kObservationPeriod);
  EXPECT_EQ(links[3].stamp, kTuesday + 3 * kObservationPeriod);
  EXPECT_EQ(links[3].accepted, 1);
  // Two processes that begin with the store agree on a third day.
  std::vector<double> probabilities;
  for (int process = 0; process < 2; ++process) {
    const auto places = begin("");
    places->load(path_);
    const PlaceOutput output = observe(*places, kTuesday + 86'400 * kObservationPeriod, 3);
    double of_monday = -1.0;
    for (const LikelyPlace& place : output.belief.likeliest) {
      EXPECT_EQ((place.at.stamp - kMonday) % (86'400 * kObservationPeriod), 3 * kObservationPeriod);
      if (place.at.session == monday) of_monday = place.probability;
    }
    EXPECT_EQ(output.belief.likeliest.size(), 2u) << "each session names its observation of the place";
    EXPECT_GT(of_monday, 0.0);
    probabilities.push_back(of_monday);
  }
  EXPECT_EQ(probabilities[0], probabilities[1]);
}

TEST_F(LivePlacesTest, WhatThePoseGraphWithdrawsIsNotLearnt) {
  drive(*begin(path_), kMonday, 0, 4);
  const std::string monday = sessions(path_).at(0).id;
  {
    const auto places = begin(path_);
    drive(*places, kTuesday, 0, 4);
    urban_nav_core::MetricClosure closure = acceptedClosure(monday, kMonday, kTuesday);
    places->addVerdict(closure);
    closure.source = "pose_graph";
    closure.verdict = urban_nav_core::ClosureVerdict::Rejected;
    places->addVerdict(closure);
    closure.source = "loop_metric";
    closure.verdict = urban_nav_core::ClosureVerdict::Accepted;  // is late
    places->addVerdict(closure);
    places->commit();
  }
  Store store(path_, Access::Read);
  std::vector<std::int64_t> accepted;
  TableStore<urban_nav_store::PlaceLink>(store).forEach(
      sessions(path_).at(1).id, [&](const urban_nav_store::PlaceLink& link) { accepted.push_back(link.accepted); });
  EXPECT_EQ(accepted, (std::vector<std::int64_t>{0}));
}

TEST_F(LivePlacesTest, WhatComesWhileTheStoreIsInUseIsNotLost) {
  auto other = std::make_unique<Store>(path_, Access::Write);
  const auto places = begin(path_);
  drive(*places, kMonday, 0, 3);
  EXPECT_EQ(places->report().reason_name, "NotStored");
  EXPECT_TRUE(places->report().is_error);
  EXPECT_NE(places->report().status.sentence.find(path_), std::string::npos);
  EXPECT_THROW(places->save(folder_.file("copy.db")), urban_nav_core::UserError);
  other.reset();
  wait();
  drive(*places, kMonday + 3 * kObservationPeriod, 3, 5);
  places->save(path_);
  EXPECT_EQ(places->report().reason_name, "None");
  ASSERT_EQ(sessions(path_).size(), 1u);
  EXPECT_EQ(rows(path_, sessions(path_)[0].id).size(), 5u);
}

TEST_F(LivePlacesTest, LeavesADamagedStoreAsItIs) {
  const std::string noise = "SQLite format 3, but no more of it";
  std::ofstream(path_) << noise;
  {
    const auto places = begin(path_);
    drive(*places, kMonday, 0, 2);
    EXPECT_EQ(places->report().reason_name, "NotStored");
  }
  std::ifstream file(path_);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), noise);
}

TEST_F(LivePlacesTest, StampsThatJumpBackBeginTheNextSession) {
  const auto places = begin(path_);
  drive(*places, kMonday, 0, 4);
  const PlaceOutput again = [&] {
    drive(*places, kMonday, 5, 7);
    return observe(*places, kMonday + 3 * kObservationPeriod, 1);
  }();
  places->save(path_);
  const std::vector<Session> stored = sessions(path_);
  ASSERT_EQ(stored.size(), 2u);
  const std::size_t first = stored[0].recording == "begbroke" ? 0 : 1;
  EXPECT_EQ(stored[1 - first].recording, "begbroke (2)");
  EXPECT_EQ(rows(path_, stored[first].id).size(), 4u);
  EXPECT_EQ(rows(path_, stored[1 - first].id).size(), 3u);
  EXPECT_TRUE(stored[first].complete);
  ASSERT_FALSE(again.belief.likeliest.empty());
  EXPECT_EQ(again.belief.likeliest[0].at.session, stored[first].id);
}

TEST_F(LivePlacesTest, ImagesThatBeginInTheSecondRoundOfARecordingAreOfItsSession) {
  const auto places = begin(path_);
  for (unsigned i = 0; i < 5; ++i) places->addOdometry({kMonday + i * kObservationPeriod, urban_nav_core::Pose()});
  drive(*places, kMonday, 0, 2);
  places->save(path_);
  ASSERT_EQ(sessions(path_).size(), 1u);
  EXPECT_EQ(sessions(path_)[0].recording, "begbroke (2)");
}

TEST_F(LivePlacesTest, SessionsAreThoseOfTheOdometry) {
  const auto announce = [](const std::string& recording, StampNs start) {
    return std::make_shared<const urban_nav_core::OdometrySession>(urban_nav_core::OdometrySession{
        urban_nav_store::makeSessionId({"bart", recording, start, ""}), recording, "bart", recording, start});
  };
  const auto first = announce("monday", kMonday), second = announce("monday (2)", kMonday);
  const StampNs reset_at = kMonday + 6 * kObservationPeriod;
  const auto third = announce("monday", reset_at);
  const auto places = begin(path_, true);
  drive(*places, kMonday, 0, 2);
  places->follow(first);
  drive(*places, kMonday + 2 * kObservationPeriod, 2, 4);
  // Odometry jumps back before the images do, and announces the new session.
  places->addOdometry({kMonday, urban_nav_core::Pose()});
  places->follow(first);  // poses remaining in its window
  places->follow(second);
  observe(*places, kMonday + 4 * kObservationPeriod, 4);
  drive(*places, kMonday + kObservationPeriod, 5, 8);
  const PlaceOutput again = observe(*places, kMonday + 5 * kObservationPeriod, 1);
  for (const auto& closure : again.closures) EXPECT_EQ(closure.b.session, second->id);
  // A reset of odometry begins a session without a backward jump.
  drive(*places, reset_at, 8, 9);
  places->follow(third);
  drive(*places, reset_at + kObservationPeriod, 9, 11);
  places->save(path_);
  ASSERT_EQ(sessions(path_).size(), 3u);
  EXPECT_EQ(rows(path_, first->id).size(), 5u);
  EXPECT_EQ(rows(path_, second->id).size(), 5u);
  EXPECT_EQ(rows(path_, third->id).size(), 2u);
  for (const Session& session : sessions(path_)) EXPECT_EQ(session.robot, "bart");
}

TEST_F(LivePlacesTest, ASessionWithoutOdometryIsNamedAfterItsFirstObservation) {
  const auto places = begin(path_);
  for (unsigned i = 0; i < 12; ++i) observe(*places, kMonday + i * kObservationPeriod, i);
  places->save(path_);
  ASSERT_EQ(sessions(path_).size(), 1u);
  EXPECT_EQ(sessions(path_)[0].start, kMonday);
  EXPECT_EQ(rows(path_, sessions(path_)[0].id).size(), 12u);
}

TEST_F(LivePlacesTest, ResetClearsPlacesButTheStoreKeepsThem) {
  const auto places = begin(path_);
  drive(*places, kMonday, 0, 4);
  places->reset();
  drive(*places, kMonday, 4, 5);
  const PlaceOutput output = observe(*places, kMonday + 60 * kObservationPeriod, 2);
  ASSERT_FALSE(output.belief.likeliest.empty());
  EXPECT_EQ(output.belief.likeliest[0].at.stamp, kMonday) << "the only one left, observed differently";
  EXPECT_TRUE(output.belief.likeliest[0].at.session.empty());
  places->save(path_);
  ASSERT_EQ(sessions(path_).size(), 2u);
}

TEST_F(LivePlacesTest, SavesLoadedAndStoredPlaces) {
  const std::string loaded = folder_.file("loaded.db"), saved = folder_.file("saved.db");
  drive(*begin(loaded), kMonday, 0, 3);
  const auto places = begin(path_);
  places->load(loaded);
  drive(*places, kTuesday, 3, 5);
  places->save(saved);
  const std::vector<Session> stored = sessions(saved);
  ASSERT_EQ(stored.size(), 2u);
  EXPECT_EQ(rows(saved, stored[0].id).size(), 3u);
  EXPECT_EQ(rows(saved, stored[1].id).size(), 2u);
  EXPECT_EQ(sessions(path_).size(), 1u) << "the store has the recorded places";
}

TEST_F(LivePlacesTest, PlacesThatAStoreNoLongerHasAreReported) {
  const std::string loaded = folder_.file("loaded.db");
  drive(*begin(loaded), kMonday, 0, 3);
  const std::vector<StoredPlace> all = rows(loaded, sessions(loaded)[0].id);
  ASSERT_EQ(all.size(), 3u);
  Store writer(loaded, Access::Write);
  const auto places = begin("");
  places->load(loaded);
  drive(*places, kTuesday, 0, 1);
  EXPECT_EQ(places->report().reason_name, "None");
  for (const StoredPlace& row : all) TableStore<StoredPlace>(writer).remove(row);
  writer.commit();
  drive(*places, kTuesday + kObservationPeriod, 1, 2);
  EXPECT_EQ(places->report().reason_name, "NotRead");
}

TEST_F(LivePlacesTest, SavesWithoutAStore) {
  const auto places = begin("");
  EXPECT_THROW(places->save(path_), urban_nav_core::UserError) << "nothing yet";
  drive(*places, kMonday, 0, 3);
  EXPECT_EQ(places->report().reason_name, "None");
  places->save(path_);
  ASSERT_EQ(sessions(path_).size(), 1u);
  EXPECT_EQ(rows(path_, sessions(path_)[0].id).size(), 3u);
}

}  // namespace
}  // namespace fabmap_node
