// SPDX-License-Identifier: BSD-3-Clause
// Clouds in the layouts of drivers: for any field, type, unit and reference of the times, beams must have the times of
// their measurement.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "sample_cloud.hpp"
#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"

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

constexpr double kTurn = 1e-9 * kPeriod;  // s

struct Layout {
  std::string name;
  std::vector<SampleField> fields;
  std::size_t point_step;
  double header;         ///< share of the sweep at the stamp of the header
  std::string expected;  ///< as printPointTimes()
  bool is_big_endian = false;
  StampNs begin = kBegin;
  double resolution = 0.0;  ///< s, of the times
};

std::ostream& operator<<(std::ostream& out, const Layout& layout) { return out << layout.name; }

SampleField timeField(const char* name, std::uint32_t offset, Number number, SampleField::Value value) {
  return {{name, offset, number}, std::move(value)};
}

/// Value relative to the begin of the sweep, in units of `ns` nanoseconds.
SampleField::Value fromBegin(double ns) {
  return [ns](const SamplePoint& p, double, double) { return p.share * kPeriod / ns; };
}
/// Value relative to the end of the sweep, below zero.
SampleField::Value fromEnd(double ns) {
  return [ns](const SamplePoint& p, double, double) { return (p.share - 1.0) * kPeriod / ns; };
}
/// Stamp of the point.
SampleField::Value asStamp(double ns) {
  return [ns](const SamplePoint& p, double, double begin) { return (begin + p.share * kPeriod) / ns; };
}
SampleField::Value constant(double value) {
  return [value](const SamplePoint&, double, double) { return value; };
}
SampleField intensity(std::uint32_t offset) {
  return {{"intensity", offset, Number::Float32}, [](const SamplePoint& p, double, double) { return 8.0 * p.ring; }};
}

/// Layouts of drivers.
std::vector<Layout> driverLayouts() {
  return {
      {"velodyne",
       withPlaces({intensity(12), ringField("ring", 16, Number::UInt16),
                   timeField("time", 18, Number::Float32, fromEnd(1e9))}),
       22, 1.0, "time,s,header"},
      {"velodyne_from_begin",
       withPlaces({intensity(16), ringField("ring", 20, Number::UInt16),
                   timeField("time", 24, Number::Float32, fromBegin(1e9))}),
       32, 0.0, "time,s,header"},
      {"ouster",
       withPlaces({intensity(16), timeField("t", 20, Number::UInt32, fromBegin(1.0)),
                   ringField("ring", 26, Number::UInt8),
                   timeField("range", 32, Number::UInt32,
                             [](const SamplePoint& p, double, double) { return 1000.0 * std::hypot(p.x, p.y); })}),
       48, 0.0, "t,ns,header"},
      {"livox_points",
       withPlaces({intensity(12), ringField("line", 17, Number::UInt8),
                   timeField("timestamp", 18, Number::Float64, asStamp(1.0))}),
       26, 0.0, "timestamp,ns,absolute"},
      {"livox_message",
       withPlaces({timeField("offset_time", 12, Number::UInt32, fromBegin(1.0)), ringField("line", 16, Number::UInt8)}),
       19, 0.0, "offset_time,ns,header"},
      {"hesai",
       withPlaces({intensity(16), timeField("timestamp", 24, Number::Float64, asStamp(1e9)),
                   ringField("ring", 32, Number::UInt16)}),
       48, 0.0, "timestamp,s,absolute"},
      {"robosense_stamped_at_end",
       withPlaces({intensity(12), ringField("ring", 16, Number::UInt16),
                   timeField("timestamp", 18, Number::Float64, asStamp(1e9))}),
       26, 1.0, "timestamp,s,absolute"}};
}

/// Further units, types and references.
std::vector<Layout> otherLayouts() {
  return {
      {"microseconds",
       withPlaces({timeField("time_us", 12, Number::UInt32, fromBegin(1e3)), ringField("ring", 16, Number::UInt8)}), 20,
       0.0, "time_us,us,header"},
      {"absolute_microseconds",
       withPlaces({timeField("stamp", 16, Number::Float64, asStamp(1e3)), ringField("channel", 24, Number::Int32)}), 28,
       0.5, "stamp,us,absolute"},
      {"milliseconds",
       withPlaces({timeField("time", 12, Number::Float32, fromBegin(1e6)), ringField("ring", 16, Number::Float32)}), 20,
       0.0, "time,ms,header"},
      {"short_microseconds_before",
       withPlaces({timeField("dt", 12, Number::Int32, fromEnd(1e3)), ringField("ring", 16, Number::Int16)}), 20, 1.0,
       "dt,us,header"},
      {"short_milliseconds",
       withPlaces({timeField("t", 12, Number::Int16, fromEnd(1e6)), ringField("ring", 14, Number::UInt8)}), 15, 1.0,
       "t,ms,header", false, kBegin, 0.001},
      {"unknown_name",
       withPlaces({intensity(12), timeField("curvature", 16, Number::Float32, fromBegin(1e6)),
                   ringField("ring", 20, Number::UInt16)}),
       22, 0.0, "curvature,ms,header"},
      {"big_endian",
       withPlaces({timeField("t", 12, Number::UInt32, fromBegin(1.0)), ringField("ring", 16, Number::UInt16)}), 18, 0.0,
       "t,ns,header", true},
      {"two_candidates",
       withPlaces({timeField("timestamp", 16, Number::Float64, constant(1.5e9)),
                   timeField("time", 24, Number::Float32, fromBegin(1e9)), ringField("ring", 28, Number::UInt16)}),
       32, 0.0, "time,s,header"},
      {"clock_begins_at_zero",
       withPlaces({timeField("timestamp", 16, Number::Float64, asStamp(1e9)), ringField("ring", 24, Number::UInt16)}),
       26, 0.0, "timestamp,s,absolute", false, 100'000'000}};
}

std::vector<Layout> layouts() {
  std::vector<Layout> all = driverLayouts();
  for (Layout& layout : otherLayouts()) all.push_back(std::move(layout));
  return all;
}

SampleCloud makeCloud(const Layout& layout, int k) {
  return SampleCloud(sampleTurn(), layout.fields, layout.point_step, layout.begin + k * kPeriod,
                     static_cast<StampNs>(layout.header * kPeriod), layout.is_big_endian);
}

CloudConvention survey(const Layout& layout, const CloudOptions& options = {}) {
  CloudSurvey survey(options);
  for (int k = 0; !survey.isComplete(); ++k) survey.add(makeCloud(layout, k).view());
  return survey.conclude();
}

class CloudLayouts : public ::testing::TestWithParam<Layout> {};

TEST_P(CloudLayouts, TheTimesOfPointsAreFound) {
  const Layout& layout = GetParam();
  const CloudConvention found = survey(layout);
  EXPECT_EQ(printPointTimes(found.times), layout.expected);
  EXPECT_NEAR(found.sweep_s, kTurn, 0.02 * kTurn);
  EXPECT_NEAR(found.middle, (0.5 - layout.header) * kTurn, 0.001);
  EXPECT_EQ(found.ring_count, 16U);
}

TEST_P(CloudLayouts, BeamsHaveTheTimeRingAndDirectionOfTheirPoint) {
  const Layout& layout = GetParam();
  const SweepReader reader(survey(layout), {});
  SampleCloud cloud = makeCloud(layout, 20);
  const ReadSweep read = reader.read(cloud.view());
  const StampNs begin = layout.begin + 20 * kPeriod;
  const std::vector<SamplePoint> points = sampleTurn();
  ASSERT_EQ(read.sweep.beams.size(), points.size());
  EXPECT_EQ(read.sweep.times, Sweep::Times::Measured);
  EXPECT_NEAR(static_cast<double>(read.sweep.reference - begin), 0.5 * kPeriod, 1.1e6);
  EXPECT_TRUE(std::is_sorted(read.sweep.beams.begin(), read.sweep.beams.end(),
                             [](const Beam& a, const Beam& b) { return a.stamp < b.stamp; }));
  const double coarse = layout.resolution / kTurn;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const Beam& beam = read.sweep.beams[i];
    const double share = shareOfTurn(beam.direction.x(), beam.direction.y(), true);
    EXPECT_NEAR(static_cast<double>(beam.stamp - begin) / kPeriod, share, 0.0005 + coarse) << i;
    const double elevation = std::asin(beam.direction.z()) * 180.0 / M_PI;
    EXPECT_NEAR(elevation, 2.0 * beam.ring - 16.0, 0.01) << i;
    EXPECT_NEAR(beam.column, share * 360.0, 1.6 + 360.0 * coarse) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AsDriversWriteThem, CloudLayouts, ::testing::ValuesIn(layouts()),
                         [](const auto& each) { return each.param.name; });

/// Layouts of one time field in every type that holds it to 2 ms, for all units and references.
std::vector<Layout> combinedLayouts() {
  struct Type {
    Number number;
    const char* name;
    double least, most;
    double digits;  ///< of the significand, bits
  };
  const std::vector<Type> types = {
      {Number::Float32, "float32", -1e30, 1e30, 24}, {Number::Float64, "float64", -1e30, 1e30, 53},
      {Number::UInt32, "uint32", 0.0, 4.2e9, 32},    {Number::Int32, "int32", -2.1e9, 2.1e9, 31},
      {Number::UInt16, "uint16", 0.0, 65535.0, 16},  {Number::Int16, "int16", -32768.0, 32767.0, 15}};
  std::vector<Layout> all;
  for (const PointTimes::Unit unit : {PointTimes::Unit::Seconds, PointTimes::Unit::Milliseconds,
                                      PointTimes::Unit::Microseconds, PointTimes::Unit::Nanoseconds}) {
    const double ns = nanoseconds(unit);
    for (const Type& type : types)
      for (const std::string reference : {"begin", "end", "absolute"}) {
        const bool is_stamp = reference == "absolute", is_float = type.digits == 24 || type.digits == 53;
        const double low = is_stamp ? kBegin / ns : reference == "end" ? -kPeriod / ns : 0.0;
        const double high = is_stamp ? (kBegin + 40.0 * kPeriod) / ns : reference == "end" ? 0.0 : kPeriod / ns;
        const double step = is_float ? std::max(std::abs(low), high) * std::exp2(-type.digits) : 1.0;  // units
        if (low < type.least || high > type.most || step * ns > 2e6) continue;
        all.push_back({std::string(type.name) + "_" + toString(unit) + "_" + reference,
                       withPlaces({timeField("t", 16, type.number,
                                             is_stamp             ? asStamp(ns)
                                             : reference == "end" ? fromEnd(ns)
                                                                  : fromBegin(ns)),
                                   ringField("ring", 24, Number::UInt16)}),
                       26, reference == "end" ? 1.0 : 0.0,
                       std::string("t,") + toString(unit) + (is_stamp ? ",absolute" : ",header"), false, kBegin,
                       1e-9 * (step * ns)});
      }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(InEveryTypeUnitAndReference, CloudLayouts, ::testing::ValuesIn(combinedLayouts()),
                         [](const auto& each) { return each.param.name; });

/// Field with stamps that were converted to single precision.
Layout roundedStamps(Number number, double ns, const char* expected) {
  const SampleField::Value exact = asStamp(ns);
  return {"rounded",
          withPlaces({timeField("timestamp", 16, number,
                                [exact](const SamplePoint& p, double header, double begin) {
                                  return static_cast<double>(static_cast<float>(exact(p, header, begin)));
                                }),
                      ringField("ring", 24, Number::UInt16)}),
          26, 0.5, expected};
}

TEST(CloudLayoutsTest, TimesLostToSinglePrecisionFollowFromTheRotation) {
  for (const Layout& layout : {roundedStamps(Number::Float64, 1e9, "timestamp,s,absolute"),
                               roundedStamps(Number::Float32, 1e9, "timestamp,s,absolute"),
                               roundedStamps(Number::Float64, 1.0, "timestamp,ns,absolute")}) {
    const CloudConvention found = survey(layout);
    EXPECT_EQ(printPointTimes(found.times), layout.expected);
    EXPECT_EQ(found.fault, PointTimesFault::Constant);
    SampleCloud cloud = makeCloud(layout, 20);
    const ReadSweep read = SweepReader(found, {}).read(cloud.view());
    EXPECT_EQ(read.sweep.times, Sweep::Times::Measured);
    EXPECT_EQ(read.sweep.reference, cloud.view().stamp);
    EXPECT_EQ(read.sweep.beams.size(), sampleTurn().size());
    const StampNs begin = layout.begin + 20 * kPeriod;
    for (const Beam& beam : read.sweep.beams)
      ASSERT_NEAR(static_cast<double>(beam.stamp - begin) / kPeriod,
                  shareOfTurn(beam.direction.x(), beam.direction.y(), true), 0.005);
  }
}

TEST(CloudLayoutsTest, SinglePrecisionWithoutARotationGivesNoTimes) {
  const Layout layout = roundedStamps(Number::Float64, 1e9, "timestamp,s,absolute");
  std::vector<SamplePoint> points = sampleTurn();  // ring by ring
  std::stable_sort(points.begin(), points.end(),
                   [](const SamplePoint& a, const SamplePoint& b) { return a.ring < b.ring; });
  SampleCloud cloud(points, layout.fields, layout.point_step, layout.begin, 0);
  const ReadSweep read = SweepReader(survey(layout), {}).read(cloud.view());
  EXPECT_EQ(read.times, ReadSweep::Times::Constant);
  EXPECT_EQ(read.sweep.times, Sweep::Times::Unknown);
}

TEST(CloudLayoutsTest, AConstantTimeThatIsNotRoundedIsNamed) {
  const CloudConvention found = survey(
      {"constant", withPlaces({timeField("timestamp", 16, Number::Float64, constant(1.5e9 + 0.3))}), 24, 0.5, "none"});
  EXPECT_FALSE(found.times.areKnown());
  EXPECT_EQ(found.fault, PointTimesFault::Constant);
}

TEST(CloudLayoutsTest, WithoutTimesSweepsHaveTheTimeOfTheHeader) {
  const Layout layout{"none", withPlaces({intensity(12)}), 16, 0.5, "none"};
  const CloudConvention found = survey(layout);
  EXPECT_FALSE(found.times.areKnown());
  EXPECT_EQ(found.fault, PointTimesFault::Absent);
  EXPECT_NEAR(found.sweep_s, kTurn, 1e-6);
  SampleCloud cloud = makeCloud(layout, 3);
  const ReadSweep read = SweepReader(found, {}).read(cloud.view());
  EXPECT_EQ(read.sweep.times, Sweep::Times::Unknown);
  EXPECT_EQ(read.sweep.reference, cloud.view().stamp);
  ASSERT_EQ(read.sweep.beams.size(), 16U * 360U);
  for (const Beam& beam : read.sweep.beams) ASSERT_EQ(beam.stamp, read.sweep.reference);
}

TEST(CloudLayoutsTest, RingNumbersAndRangesAreNoTimes) {
  const Layout layout{
      "rings_alone",
      withPlaces({intensity(12), ringField("ring", 16, Number::UInt16),
                  timeField("value", 20, Number::Float32,
                            [](const SamplePoint& p, double, double) { return 1e4 * std::hypot(p.x, p.y); })}),
      24, 0.5, "none"};
  EXPECT_FALSE(survey(layout).times.areKnown());
}

TEST(CloudLayoutsTest, ThePartOfAStampBelowASecondIsNotTakenForATimeFromTheHeader) {
  const Layout layout{"nanoseconds_of_stamp",
                      withPlaces({timeField("timestamp_nsec", 12, Number::UInt32,
                                            [](const SamplePoint& p, double, double begin) {
                                              return std::fmod(begin + p.share * kPeriod, 1e9);
                                            })}),
                      16, 0.0, "none"};
  EXPECT_FALSE(survey(layout).times.areKnown());
}

TEST(CloudLayoutsTest, WhatTheUserStatesDecides) {
  Layout layout = layouts()[0];
  CloudOptions options;
  options.times = parsePointTimes("time,ms,header");
  const CloudConvention wrong = survey(layout, options);
  EXPECT_EQ(printPointTimes(wrong.times), "time,ms,header");
  EXPECT_EQ(wrong.fault, PointTimesFault::Unit);
  EXPECT_EQ(wrong.suspect, "time");
  options.times = PointTimes();
  EXPECT_FALSE(survey(layout, options).times.areKnown());
  EXPECT_EQ(survey(layout, options).fault, PointTimesFault::None);
  options.times = parsePointTimes("time,s,header");
  EXPECT_EQ(survey(layout, options).fault, PointTimesFault::None);
}

TEST(CloudLayoutsTest, DeskewedSweepsHaveOneTime) {
  CloudOptions options;
  options.are_deskewed = true;
  const Layout layout = layouts()[0];
  SampleCloud cloud = makeCloud(layout, 1);
  const ReadSweep read = SweepReader(survey(layout, options), options).read(cloud.view());
  EXPECT_EQ(read.sweep.times, Sweep::Times::Deskewed);
  EXPECT_EQ(read.sweep.reference, cloud.view().stamp);
  for (const Beam& beam : read.sweep.beams) ASSERT_EQ(beam.stamp, read.sweep.reference);
}

}  // namespace
}  // namespace urban_nav_core
