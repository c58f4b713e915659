// SPDX-License-Identifier: BSD-3-Clause
// Free of ROS: compiled under the sanitizers too.
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "sample_cloud.hpp"
#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace urban_nav_core {
namespace {

using testing::kBegin;
using testing::kPeriod;
using testing::ringField;
using testing::SampleCloud;
using testing::SampleField;
using testing::SamplePoint;
using testing::sampleTurn;
using testing::withPlaces;
using Number = CloudField::Number;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// x, y, z, intensity, ring and time (s, from the begin) of a point in 24 bytes.
std::vector<SampleField> fields(const SampleField::Value& time) {
  return withPlaces({{{"intensity", 12, Number::Float32}, [](const SamplePoint&, double, double) { return 0.5; }},
                     ringField("ring", 16, Number::UInt16),
                     {{"time", 20, Number::Float32}, time}});
}
double timeFromBegin(const SamplePoint& p, double, double) { return 1e-9 * kPeriod * p.share; }

SampleCloud makeCloud(const std::vector<SamplePoint>& points, int k = 0,
                      const SampleField::Value& time = timeFromBegin) {
  return SampleCloud(points, fields(time), 24, kBegin + k * kPeriod, 0);
}

SweepReader soundReader(const CloudOptions& options = {}) {
  CloudSurvey survey(options);
  for (int k = 0; !survey.isComplete(); ++k) survey.add(makeCloud(sampleTurn(), k).view());
  return SweepReader(survey.conclude(), options);
}

void expectSound(const Sweep& sweep) {
  for (const Beam& beam : sweep.beams) {
    ASSERT_NEAR(beam.direction.norm(), 1.0F, 1e-4F);
    ASSERT_TRUE(beam.range > 0.0F && std::isfinite(beam.range));
    ASSERT_TRUE(beam.intensity >= 0.0F && beam.intensity <= 255.0F);
    ASSERT_LE(std::abs(beam.stamp - sweep.reference), 1'000'000'001);
  }
}

TEST(SweepReaderTest, PointsThatAreNotMeasuredAreCountedAndLeftOut) {
  std::vector<SamplePoint> points = sampleTurn();
  for (std::size_t i = 0; i < 100; ++i) points[i].x = kNotANumber;
  for (std::size_t i = 100; i < 150; ++i) points[i].x = points[i].y = points[i].z = 0.0;
  points[150].y = std::numeric_limits<double>::infinity();
  points[151].z = 70'000.0;
  for (std::size_t i = 200; i < 240; ++i) points[i].x = 0.3, points[i].y = points[i].z = 0.1;
  SampleCloud cloud = makeCloud(points);
  const ReadSweep read = soundReader().read(cloud.view());
  EXPECT_EQ(read.points, points.size());
  EXPECT_EQ(read.invalid, 152U);
  EXPECT_EQ(read.near, 40U);
  EXPECT_EQ(read.sweep.beams.size(), points.size() - 192);
  expectSound(read.sweep);
}

TEST(SweepReaderTest, IntensitiesUpToOneAreScaled) {
  SampleCloud cloud = makeCloud(sampleTurn());
  const ReadSweep read = soundReader().read(cloud.view());
  EXPECT_FLOAT_EQ(read.sweep.beams.front().intensity, 127.5F);
}

TEST(SweepReaderTest, AllPointsInvalidGivesASweepWithoutBeams) {
  std::vector<SamplePoint> points = sampleTurn();
  for (SamplePoint& point : points) point.x = point.y = point.z = kNotANumber;
  SampleCloud cloud = makeCloud(points);
  const ReadSweep read = soundReader().read(cloud.view());
  EXPECT_TRUE(read.sweep.beams.empty());
  EXPECT_EQ(read.invalid, points.size());
}

TEST(SweepReaderTest, ACloudWithoutUsableTimesKeepsItsPlaceAmongTheOthers) {
  const SweepReader reader = soundReader();
  SampleCloud constant = makeCloud(sampleTurn(), 0, [](const SamplePoint&, double, double) { return 0.0; });
  SampleCloud decreasing =
      makeCloud(sampleTurn(), 0, [](const SamplePoint& p, double, double) { return 0.1 * (1.0 - p.share); });
  SampleCloud endless =
      makeCloud(sampleTurn(), 0, [](const SamplePoint& p, double, double) { return 100.0 * p.share; });
  const std::pair<SampleCloud*, ReadSweep::Times> cases[] = {{&constant, ReadSweep::Times::Constant},
                                                             {&decreasing, ReadSweep::Times::Decreasing},
                                                             {&endless, ReadSweep::Times::Span}};
  for (const auto& [cloud, expected] : cases) {
    const ReadSweep read = reader.read(cloud->view());
    EXPECT_EQ(read.times, expected);
    EXPECT_EQ(read.sweep.times, Sweep::Times::Unknown);
    EXPECT_NEAR(static_cast<double>(read.sweep.reference - kBegin), 0.5 * kPeriod, 1e6);
    EXPECT_EQ(read.sweep.beams.size(), 16U * 360U);
  }
}

TEST(SweepReaderTest, DecreasingTimesAreNotUsedUnlessTheUserStatesThem) {
  const auto backward = [](const SamplePoint& p, double, double) { return -0.1 * p.share; };
  for (const bool is_given : {false, true}) {
    CloudOptions options;
    if (is_given) options.times = parsePointTimes("time,s,header");
    CloudSurvey survey(options);
    for (int k = 0; !survey.isComplete(); ++k) survey.add(makeCloud(sampleTurn(), k, backward).view());
    const CloudConvention convention = survey.conclude();
    EXPECT_EQ(convention.fault, is_given ? PointTimesFault::None : PointTimesFault::Decreasing);
    SampleCloud cloud = makeCloud(sampleTurn(), 9, backward);
    const ReadSweep read = SweepReader(convention, options).read(cloud.view());
    EXPECT_EQ(read.sweep.times, is_given ? Sweep::Times::Measured : Sweep::Times::Unknown);
    EXPECT_NEAR(static_cast<double>(read.sweep.reference - (kBegin + 9 * kPeriod)), -0.5 * kPeriod, 1e6);
  }
}

TEST(SweepReaderTest, TimesWithinRingsMayFall) {
  // Ring by ring, against the rotation: as range images are stored.
  std::vector<SamplePoint> points = sampleTurn();
  std::stable_sort(points.begin(), points.end(), [](const SamplePoint& a, const SamplePoint& b) {
    return std::make_pair(a.ring, -a.column) < std::make_pair(b.ring, -b.column);
  });
  CloudSurvey survey;
  for (int k = 0; !survey.isComplete(); ++k) survey.add(makeCloud(points, k).view());
  EXPECT_EQ(printPointTimes(survey.conclude().times), "time,s,header");
  SampleCloud cloud = makeCloud(points);
  const ReadSweep read = SweepReader(survey.conclude(), {}).read(cloud.view());
  EXPECT_EQ(read.times, ReadSweep::Times::Used);
}

TEST(SweepReaderTest, TimesOfAnotherClockArePlacedByTheHeader) {
  constexpr double kLater = 37.0;  // s: TAI minus UTC
  const auto stamp = [](const SamplePoint& p, double, double begin) { return 1e-9 * begin + 0.1 * p.share + kLater; };
  const std::vector<SampleField> all =
      withPlaces({ringField("ring", 12, Number::UInt16), {{"timestamp", 16, Number::Float64}, stamp}});
  CloudSurvey survey;
  for (int k = 0; !survey.isComplete(); ++k)
    survey.add(SampleCloud(sampleTurn(), all, 24, kBegin + k * kPeriod, kPeriod).view());
  const CloudConvention convention = survey.conclude();
  EXPECT_EQ(convention.fault, PointTimesFault::Clock);
  EXPECT_NEAR(convention.clock, kLater - 0.05, 0.002);
  SampleCloud cloud(sampleTurn(), all, 24, kBegin, kPeriod);
  const ReadSweep read = SweepReader(convention, {}).read(cloud.view());
  EXPECT_EQ(read.sweep.times, Sweep::Times::Measured);
  EXPECT_NEAR(static_cast<double>(read.sweep.reference - kBegin), 0.5 * kPeriod, 1e6);
  EXPECT_NEAR(read.clock, kLater, 0.002);
  expectSound(read.sweep);
}

TEST(SweepReaderTest, OrganisedCloudsWithHolesHaveRingsByRows) {
  constexpr int kRings = 16, kColumns = 360;
  std::vector<SamplePoint> points(sampleTurn(kRings, kColumns).size());
  for (const SamplePoint& point : sampleTurn(kRings, kColumns)) {  // rows from the top, every third point a hole
    SamplePoint& place = points[static_cast<std::size_t>((kRings - 1 - point.ring) * kColumns + point.column)];
    place = point;
    if (point.column % 3 == 0) place.x = place.y = place.z = kNotANumber;
  }
  const auto makeCloud = [&](int k) {
    SampleCloud cloud(points, withPlaces({}), 16, kBegin + k * kPeriod, 0);
    cloud.view().width = kColumns;
    cloud.view().height = kRings;
    cloud.view().row_step = 16 * kColumns;
    return cloud;
  };
  CloudSurvey survey;
  for (int k = 0; !survey.isComplete(); ++k) survey.add(makeCloud(k).view());
  const CloudConvention convention = survey.conclude();
  EXPECT_EQ(convention.rings, CloudConvention::Rings::Rows);
  EXPECT_EQ(convention.columns, static_cast<std::size_t>(kColumns));
  SampleCloud cloud = makeCloud(0);
  const ReadSweep read = SweepReader(convention, {}).read(cloud.view());
  EXPECT_EQ(read.sweep.beams.size(), static_cast<std::size_t>(kRings * kColumns * 2 / 3));
  for (const Beam& beam : read.sweep.beams)
    ASSERT_NEAR(std::asin(beam.direction.z()) * 180.0 / M_PI, 2.0 * beam.ring - 16.0, 0.01);
}

TEST(SweepReaderTest, RingNumbersInTheOrderOfFiringAreOrderedByElevation) {
  const auto firing = [](const SamplePoint& p, double, double) {
    return p.ring % 2 == 0 ? p.ring / 2 : 8 + p.ring / 2;
  };
  const std::vector<SampleField> all = withPlaces({{{"ring", 12, Number::UInt16}, firing}});
  CloudSurvey survey;
  for (int k = 0; !survey.isComplete(); ++k) survey.add(SampleCloud(sampleTurn(), all, 16, kBegin, 0).view());
  EXPECT_TRUE(survey.conclude().are_rings_known);
  SampleCloud cloud(sampleTurn(), all, 16, kBegin, 0);
  const ReadSweep read = SweepReader(survey.conclude(), {}).read(cloud.view());
  for (const Beam& beam : read.sweep.beams)
    ASSERT_NEAR(std::asin(beam.direction.z()) * 180.0 / M_PI, 2.0 * beam.ring - 16.0, 0.01);
  const auto shuffled = [](const SamplePoint& p, double, double) { return (5 * p.ring) % 16; };
  const std::vector<SampleField> odd = withPlaces({{{"ring", 12, Number::UInt16}, shuffled}});
  CloudSurvey other;
  for (int k = 0; !other.isComplete(); ++k) other.add(SampleCloud(sampleTurn(), odd, 16, kBegin, 0).view());
  EXPECT_FALSE(other.conclude().are_rings_sorted);
}

TEST(SweepReaderTest, RingsWithoutPointsAreNamed) {
  std::vector<SamplePoint> points = sampleTurn();
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const SamplePoint& point) { return point.ring == 5 || point.ring == 6; }),
               points.end());
  CloudSurvey survey;
  for (int k = 0; !survey.isComplete(); ++k) survey.add(makeCloud(points, k).view());
  EXPECT_EQ(survey.conclude().absent_rings, (std::vector<std::uint16_t>{5, 6}));
  EXPECT_EQ(survey.conclude().ring_count, 16U);
}

TEST(SweepReaderTest, TruncatedAndContradictoryCloudsAreReadAsFarAsTheyGo) {
  const SweepReader reader = soundReader();
  SampleCloud cloud = makeCloud(sampleTurn());
  CloudView truncated = cloud.view();
  truncated.size = 24 * 1000 + 5;
  EXPECT_EQ(reader.read(truncated).points, 1000U);
  EXPECT_EQ(reader.read(truncated).missing, 16U * 360U - 1000U);
  CloudView announced = cloud.view();
  announced.width = announced.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_LE(reader.read(announced).sweep.beams.size(), 16U * 360U);
  CloudView steps = cloud.view();
  steps.width = 360;
  steps.height = 16;
  steps.row_step = 7;
  EXPECT_EQ(reader.read(steps).points, 16U * 360U);
  CloudView without = cloud.view();
  without.fields.erase(without.fields.begin());
  EXPECT_NE(reader.read(without).fault.find("x"), std::string::npos);
  CloudView empty = cloud.view();
  empty.point_step = 0;
  EXPECT_FALSE(reader.read(empty).fault.empty());
  EXPECT_TRUE(reader.read({}).sweep.beams.empty());
}

TEST(SweepReaderTest, TheStateOfAConventionIsReadBack) {
  CloudConvention convention = soundReader().convention();
  Archive writer;
  convention.archive(writer);
  const std::string bytes = writer.take();
  CloudConvention other;
  Archive reader(bytes, "test");
  other.archive(reader);
  reader.finish();
  EXPECT_EQ(other.order, convention.order);
  EXPECT_EQ(printPointTimes(other.times), printPointTimes(convention.times));
  EXPECT_EQ(other.columns, convention.columns);
}

/// Reads a text as a cloud: the first bytes are its layout.
CloudView toView(const std::string& text) {
  CloudView view;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<std::uint32_t>(bytes[i]) : 0U; };
  view.stamp = kBegin;
  view.width = at(0) | at(1) << 8U;
  view.height = at(2);
  view.point_step = at(3);
  view.row_step = at(4) << 4U;
  view.is_big_endian = at(5) % 2 == 1;
  const char* names[] = {"x", "y", "z", "intensity", "ring", "time", "timestamp", "t"};
  for (std::size_t i = 0; i < 8; ++i)
    view.fields.push_back({names[i], at(6 + 2 * i), static_cast<Number>(at(7 + 2 * i) % 16), 1});
  constexpr std::size_t kLayout = 22;
  if (text.size() > kLayout) view.data = bytes + kLayout, view.size = text.size() - kLayout;
  return view;
}

TEST(SweepReaderTest, DamagedCloudsGiveSoundSweeps) {
  std::vector<SamplePoint> points = sampleTurn(8, 32);
  SampleCloud cloud = makeCloud(points);
  std::string seed = {char(0), char(1), char(1), char(24), char(0), char(0)};
  for (const auto& [offset, number] :
       {std::pair<int, int>{0, 7}, {4, 7}, {8, 7}, {12, 7}, {16, 4}, {20, 7}, {0, 8}, {4, 6}})
    seed += {static_cast<char>(offset), static_cast<char>(number)};
  cloud.view();
  seed.append(cloud.bytes().begin(), cloud.bytes().end());
  const auto read = [](const std::string& text) {
    const CloudView view = toView(text);
    CloudSurvey survey;
    survey.add(view);
    expectSound(SweepReader(survey.conclude(), {}).read(view).sweep);
    CloudOptions options;
    options.times = parsePointTimes("timestamp,ns,absolute");
    expectSound(SweepReader(survey.conclude(), options).read(view).sweep);
  };
  EXPECT_EQ(toView(seed).point_step, 24U);
  EXPECT_EQ(CloudPoints(toView(seed)).size(), 256U);
  EXPECT_EQ(testing::fuzzText({seed}, read).failure.substr(0, 300), "");
}

}  // namespace
}  // namespace urban_nav_core
