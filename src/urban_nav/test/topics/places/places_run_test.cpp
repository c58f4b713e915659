// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/places_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "support/place_images.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {
namespace {

using fabmap_node::PlaceBelief;
using fabmap_node::PlaceKnowledge;
using testing::sceneImage;
using urban_nav_core::StampNs;
using urban_nav_store::PlaceLink;
using urban_nav_store::StoredPlace;

constexpr StampNs kObservationPeriod = 6'000'000'000;  // ns, at 1 m/s
constexpr double kObservationSpacing = 6.0;            // m, farther than places reach
constexpr unsigned kObservations = 8, kDusk = 100, kElsewhere = 500;

/// The view of a place: what daylight shows of it on the left, and of dusk on the right.
cv::Mat viewInLight(unsigned place, double share_of_day, int shift) {
  cv::Mat view = sceneImage(kDusk + place, shift);
  const int columns = static_cast<int>(share_of_day * view.cols);
  sceneImage(place, shift).colRange(0, columns).copyTo(view.colRange(0, columns));
  return view;
}

/// Three drives past the same places: by day, at dusk, and at night, which resembles dusk more than day; then one
/// elsewhere.
class PlacesOfDays : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = loadPlaceModel(fabmap_node::Parameters());
    describe("day", 0, 1.0, 0);
    describe("dusk", 1, 0.5, 0);
    describe("night", 2, 0.2, 0);
    describe("elsewhere", 3, 0.2, kElsewhere);
  }
  static void TearDownTestSuite() {
    rows_.clear();
    model_.reset();
  }
  PlacesOfDays() {
    context_.store = &store_;
    context_.joins = context_.divides = true;
    urban_nav_store::TableStore<StoredPlace> places(store_);
    for (const StoredPlace& row : rows_) {
      if (context_.names.empty() || context_.names.back() != row.session) addSession(row);
      places.put(row);
      SmoothedFrame frame;
      frame.stamp = row.stamp;
      const double travelled = kObservationSpacing * static_cast<double>(context_.previous.runs.back().settled.size());
      frame.T_odom_base.pose = urban_nav_core::Pose(Eigen::Quaterniond::Identity(), {travelled, 0.0, 0.0});
      context_.previous.runs.back().settled.push_back(frame);
    }
  }

  static void describe(const std::string& name, unsigned day, double share_of_day, unsigned first) {
    PlaceWriter writer(model_, fabmap_node::Parameters(), name, PlaceWriter::Kind::Place, true);
    for (unsigned i = 0; i < kObservations; ++i) {
      const auto view = [=] {
        return std::vector<cv::Mat>{viewInLight(first + i, share_of_day, static_cast<int>(2 * day))};
      };
      if (const auto described = writer.add(stamp(day, i), view)) rows_.push_back(described->row);
    }
    while (const auto described = writer.next()) rows_.push_back(described->row);
  }
  void addSession(const StoredPlace& first) {
    store_.sessions().put(urban_nav_store::Session{first.session, first.session, "", "", first.stamp, true});
    context_.names.push_back(first.session);
    context_.previous.ids.push_back(first.session);
    context_.previous.runs.emplace_back();
  }

  PlacesRun run() const { return runPlaces(parameters_, *model_, context_); }
  PlacesRun runWith(std::vector<PlaceLink> links) {
    context_.learnt = std::move(links);
    return run();
  }

  static StampNs stamp(unsigned day, unsigned i) { return (14400 * StampNs{day} + i) * kObservationPeriod; }
  static PlaceLink linkBetween(const std::string& session, StampNs at, const std::string& earlier, StampNs earlier_at) {
    PlaceLink link{session, at, earlier, earlier_at};
    link.metres = 0.3;
    return link;
  }
  static std::vector<PlaceLink> linksOfDusk() {
    std::vector<PlaceLink> links;
    for (unsigned i = 0; i < kObservations; ++i) links.push_back(linkBetween("dusk", stamp(1, i), "day", stamp(0, i)));
    return links;
  }
  /// Returns the probability of the right place of the first day at each observation of a session.
  static std::vector<double> ofFirstDay(const PlacesRun& run, unsigned session) {
    std::vector<double> probabilities(kObservations, 0.0);
    for (unsigned i = 0; i < kObservations; ++i)
      for (const fabmap_node::LikelyPlace& place : run.beliefs[session][i].likeliest)
        if (place.at.stamp == stamp(0, i)) probabilities[i] = place.probability;
    return probabilities;
  }
  static void expectSameBeliefs(const std::vector<PlaceBelief>& a, const std::vector<PlaceBelief>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].p_new, b[i].p_new) << i;
      ASSERT_EQ(a[i].likeliest.size(), b[i].likeliest.size()) << i;
      for (std::size_t k = 0; k < a[i].likeliest.size(); ++k) {
        EXPECT_EQ(a[i].likeliest[k].at, b[i].likeliest[k].at) << i;
        EXPECT_EQ(a[i].likeliest[k].probability, b[i].likeliest[k].probability) << i;
      }
    }
  }

  const fabmap_node::Parameters parameters_;
  const urban_nav_input::testing::TemporaryFolder folder_;
  urban_nav_store::Store store_{folder_.file("days.db"), urban_nav_store::Access::Write};
  const MapOptions options_;
  Console console_;
  MapContext context_{options_, console_};

  static inline std::shared_ptr<const LoadedPlaceModel> model_;
  static inline std::vector<StoredPlace> rows_;  // of all sessions
};

TEST_F(PlacesOfDays, WhatDuskWasConfirmedToShowHelpsAtNight) {
  const PlacesRun before = run(), learnt = runWith(linksOfDusk());
  const std::vector<double> p_before = ofFirstDay(before, 2), p_learnt = ofFirstDay(learnt, 2);
  double gain = 0.0;
  for (unsigned i = 0; i < kObservations; ++i) {
    gain += (p_learnt[i] - p_before[i]) / kObservations;
    EXPECT_LE(learnt.beliefs[2][i].p_new, before.beliefs[2][i].p_new) << i;
  }
  EXPECT_GT(gain, 0.5);
  for (const unsigned earlier : {0U, 1U}) expectSameBeliefs(learnt.beliefs[earlier], before.beliefs[earlier]);
}

TEST_F(PlacesOfDays, NothingElseBecomesKnown) {
  const PlacesRun learnt = runWith(linksOfDusk());
  for (const PlaceBelief& belief : learnt.beliefs[3]) {
    EXPECT_NE(belief.knowledge, PlaceKnowledge::Known);
    EXPECT_GT(belief.p_new, 0.5);
  }
  for (unsigned i = 0; i < kObservations; ++i)
    for (const fabmap_node::LikelyPlace& place : learnt.beliefs[2][i].likeliest)
      EXPECT_TRUE(place.at.stamp % stamp(1, 0) == stamp(0, i) || place.probability < 0.9) << i;
}

TEST_F(PlacesOfDays, LinksToSessionsThatHaveNotPassedAreIgnored) {
  const PlacesRun before = run();
  const PlacesRun same =
      runWith({linkBetween("dusk", stamp(1, 3), "sunday", 3), linkBetween("day", stamp(0, 3), "dusk", stamp(1, 3)),
               linkBetween("sunday", 3, "day", stamp(0, 3))});
  for (unsigned session = 0; session < 4; ++session) expectSameBeliefs(same.beliefs[session], before.beliefs[session]);
}

TEST_F(PlacesOfDays, KnownSessionsTeachWhatTheirStoreHolds) {
  const PlacesRun learnt = runWith(linksOfDusk());
  context_.learnt.reset();
  context_.is_frozen = {true, true, false, false};
  const std::vector<double> p_before = ofFirstDay(run(), 2);
  const auto store = [&](std::int64_t accepted) {
    for (PlaceLink each : linksOfDusk()) {
      each.accepted = accepted;
      urban_nav_store::TableStore<PlaceLink>(store_).put(each);
    }
  };
  store(0);
  EXPECT_EQ(ofFirstDay(run(), 2), p_before) << "withdrawn";
  store(1);
  EXPECT_EQ(ofFirstDay(run(), 2), ofFirstDay(learnt, 2));
}

TEST_F(PlacesOfDays, DescriptorsComparedBeforeOnlySaveTime) {
  fabmap_node::AgreementCache cache;
  runPlaces(parameters_, *model_, context_, &cache);
  const std::size_t pairs = cache.pairs();
  EXPECT_GT(pairs, kObservations);
  runPlaces(parameters_, *model_, context_, &cache);
  EXPECT_EQ(cache.pairs(), pairs) << "all were known";
  context_.learnt = linksOfDusk();
  context_.groups = {0, 0, 0, 3};
  const PlacesRun fresh = run(), known = runPlaces(parameters_, *model_, context_, &cache);
  for (unsigned session = 0; session < 4; ++session) expectSameBeliefs(known.beliefs[session], fresh.beliefs[session]);
}

TEST_F(PlacesOfDays, TheResultDoesNotDependOnTheNumberOfThreads) {
  const PlacesRun learnt = runWith(linksOfDusk());
  const urban_nav_core::ThreadLimit one_thread(1);
  const PlacesRun again = run();
  for (unsigned session = 0; session < 4; ++session) expectSameBeliefs(again.beliefs[session], learnt.beliefs[session]);
}

}  // namespace
}  // namespace urban_nav
