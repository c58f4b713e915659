// SPDX-License-Identifier: BSD-3-Clause
// Recordings with 3D LiDARs, alone and with images, good and bad.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/examination/diagnosis.hpp"
#include "urban_nav_input/recording/mcap_writer.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;

constexpr double kFirstSweep = 1.5e9, kSweepPeriod = 0.1;  // s
constexpr int kBagSweeps = 20, kBagRings = 16;
constexpr std::uint32_t kBagPoints = 5760;

/// One point of a sweep as Velodyne's driver writes it; time in s, relative to the stamp at the end of the sweep.
struct BagPoint {
  float x, y, z, intensity, time;
  std::uint16_t ring;
};

std::vector<BagPoint> sweepPoints() {
  std::vector<BagPoint> points;
  for (std::uint32_t i = 0; i < kBagPoints; ++i) {
    const auto ring = static_cast<std::uint16_t>(i % kBagRings);
    const double share = (i / kBagRings + 0.5) / (kBagPoints / kBagRings), azimuth = M_PI * (1.0 - 2.0 * share);
    const double elevation = (2.0 * ring - kBagRings) * M_PI / 180.0;
    points.push_back({static_cast<float>(9.0 * std::cos(azimuth)), static_cast<float>(9.0 * std::sin(azimuth)),
                      static_cast<float>(9.0 * std::tan(elevation)), 100.0F,
                      static_cast<float>(kSweepPeriod * (share - 1.0)), ring});
  }
  return points;
}

sensor_msgs::PointCloud2 toCloud(const std::vector<BagPoint>& points, double begin, const std::string& frame) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ros::Time(begin + kSweepPeriod);
  cloud.header.frame_id = frame;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.height = 1;
  cloud.point_step = 22;
  cloud.row_step = cloud.point_step * cloud.width;
  const std::pair<const char*, std::uint32_t> fields[] = {{"x", 0},          {"y", 4},     {"z", 8},
                                                          {"intensity", 12}, {"ring", 16}, {"time", 18}};
  for (const auto& [name, offset] : fields) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = offset == 16 ? sensor_msgs::PointField::UINT16 : sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.data.resize(cloud.row_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint8_t* record = &cloud.data[i * cloud.point_step];
    std::memcpy(record, &points[i].x, 16);
    std::memcpy(record + 16, &points[i].ring, 2);
    std::memcpy(record + 18, &points[i].time, 4);
  }
  return cloud;
}

struct SweepRecipe {
  bool has_tf = true, has_images = false;
  std::string topic = "/points_raw", frame = "velodyne";
  double period = kSweepPeriod;  ///< s
  /// Changes the points of a sweep; returns false to leave it out.
  std::function<bool(int i, std::vector<BagPoint>& points)> change = [](int, std::vector<BagPoint>&) { return true; };
  std::function<double(int i)> clock = [](int) { return 0.0; };  ///< s that stamps of clouds are late
};

void writeSmallImages(rosbag::Bag& bag, double stamp) {
  for (const std::string side : {"left", "right"}) {
    sensor_msgs::Image image;
    image.header.stamp = ros::Time(stamp);
    image.encoding = "mono8";
    image.width = image.step = 32;
    image.height = 24;
    image.data.assign(image.step * image.height, 100);
    sensor_msgs::CameraInfo info;
    info.header.stamp = image.header.stamp;
    info.width = 32;
    info.height = 24;
    info.P = {30, 0, 15.5, side == "right" ? -6.0 : 0.0, 0, 30, 11.5, 0, 0, 0, 1, 0};
    bag.write("/stereo/" + side + "/image_raw", ros::Time(stamp + 0.01), image);
    bag.write("/stereo/" + side + "/camera_info", ros::Time(stamp + 0.01), info);
  }
}

void writeSweepBag(const std::string& path, const SweepRecipe& recipe, int from = 0, int to = kBagSweeps) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(urban_nav_ros::toStaticTransform(
      "base_link", recipe.frame, urban_nav_core::Pose(urban_nav_core::Matrix3d::Identity(), {0.5, 0.0, 1.0})));
  if (recipe.has_tf && from == 0) bag.write("/tf_static", ros::Time(kFirstSweep), transforms);
  for (int i = from; i < to; ++i) {
    const double begin = kFirstSweep + recipe.period * i;
    if (recipe.has_images) {
      writeSmallImages(bag, begin);
      writeSmallImages(bag, begin + 0.05);
    }
    std::vector<BagPoint> points = sweepPoints();
    if (!recipe.change(i, points)) continue;
    bag.write(recipe.topic, ros::Time(begin + kSweepPeriod + 0.03),
              toCloud(points, begin + recipe.clock(i), recipe.frame));
  }
}

SourceOptions sweepOptions() {
  SourceOptions options;
  options.with_sweeps = true;
  return options;
}

struct SweepReading {
  std::vector<SweepInput> sweeps;
  std::string kinds;  ///< of the findings
  std::string texts, notes;
  int pairs = 0;
  bool has_images = false;
  std::vector<InputStream> inputs;
};

SweepReading readSweepBag(const std::vector<std::string>& paths, const SourceOptions& options = sweepOptions(),
                          const BagEnd* after = nullptr) {
  const std::unique_ptr<Source> source = openSource(paths, options, after);
  SweepReading reading;
  reading.has_images = source->info().has_images;
  reading.inputs = source->info().inputs;
  for (const std::string& note : source->info().notes) reading.notes += note + "\n";
  const auto take = [&](const std::vector<SweepInput>& sweeps) {
    reading.sweeps.insert(reading.sweeps.end(), sweeps.begin(), sweeps.end());
  };
  while (const std::optional<SourceItem> item = source->next()) {
    if (item->bag_end) take(item->bag_end->sweeps);
    take(item->sweeps);
    reading.pairs += item->has_pair;
  }
  if (const auto end = source->bagEnd()) take(end->sweeps);
  take(source->sweeps());
  for (const Finding& finding : source->sensorFindings()) {
    reading.kinds += std::string(toString(finding.kind)) + " ";
    reading.texts += finding.text + "\n";
  }
  return reading;
}

StampNs findMiddle(int i) { return static_cast<StampNs>(1e9 * kFirstSweep) + 100'000'000 * i + 50'000'000; }

TEST(BagSweeps, AloneAreASession) {
  const TemporaryFolder folder;
  writeSweepBag(folder.file("a.bag"), {});
  const SweepReading reading = readSweepBag({folder.file("a.bag")});
  EXPECT_FALSE(reading.has_images);
  EXPECT_EQ(reading.pairs, 0);
  ASSERT_EQ(reading.sweeps.size(), static_cast<std::size_t>(kBagSweeps));
  for (int i = 0; i < kBagSweeps; ++i) {
    const SweepInput& input = reading.sweeps[static_cast<std::size_t>(i)];
    EXPECT_EQ(input.role, "points0");
    EXPECT_EQ(input.T_base_lidar.t().z(), 1.0);
    EXPECT_NEAR(static_cast<double>(input.sweep.reference - findMiddle(i)), 0.0, 1e6);
    EXPECT_EQ(input.sweep.times, Sweep::Times::Measured);
    EXPECT_EQ(input.sweep.beams.size(), kBagPoints);
  }
  EXPECT_EQ(reading.kinds, "");
  ASSERT_EQ(reading.inputs.size(), 1U);
  EXPECT_EQ(reading.inputs[0].topic, "/points_raw");
  EXPECT_EQ(reading.inputs[0].frame, "velodyne");
  EXPECT_EQ(reading.inputs[0].messages, kBagSweeps);
  EXPECT_EQ(printPointTimes(reading.inputs[0].lidar->times), "time,s,header");
  EXPECT_EQ(reading.inputs[0].lidar->rings, kBagRings);
  EXPECT_EQ(findSessions({folder.file("a.bag")}).size(), 1U);
}

TEST(BagSweeps, WithoutAStageThatUsesThemTheirBagIsRefused) {
  const TemporaryFolder folder;
  writeSweepBag(folder.file("a.bag"), {});
  EXPECT_THROW(openSource({folder.file("a.bag")}, {}), urban_nav_core::DataError);
}

TEST(BagSweeps, ComeWithImages) {
  const TemporaryFolder folder;
  SweepRecipe recipe;
  recipe.has_images = true;
  writeSweepBag(folder.file("a.bag"), recipe);
  const SweepReading reading = readSweepBag({folder.file("a.bag")});
  EXPECT_TRUE(reading.has_images);
  EXPECT_EQ(reading.pairs, 2 * kBagSweeps);
  EXPECT_EQ(reading.sweeps.size(), static_cast<std::size_t>(kBagSweeps));
  EXPECT_TRUE(
      std::is_sorted(reading.sweeps.begin(), reading.sweeps.end(),
                     [](const SweepInput& a, const SweepInput& b) { return a.sweep.reference < b.sweep.reference; }));
  const SweepReading without = readSweepBag({folder.file("a.bag")}, {});
  EXPECT_EQ(without.pairs, 2 * kBagSweeps);
  EXPECT_TRUE(without.sweeps.empty());
}

TEST(BagSweeps, AreBoundedWhereImagesPause) {
  const TemporaryFolder folder;
  SweepRecipe recipe;
  recipe.has_images = true;
  writeSweepBag(folder.file("a.bag"), recipe);
  recipe.has_images = false;
  recipe.has_tf = false;
  writeSweepBag(folder.file("b.bag"), recipe, kBagSweeps, 3 * kBagSweeps);
  const std::unique_ptr<Source> source = openSource({folder.file("a.bag"), folder.file("b.bag")}, sweepOptions());
  std::size_t most = 0, sum = 0;
  while (const std::optional<SourceItem> item = source->next()) {
    if (item->bag_end) sum += item->bag_end->sweeps.size();
    most = std::max(most, item->sweeps.size());
    sum += item->sweeps.size();
  }
  if (source->bagEnd()) sum += source->bagEnd()->sweeps.size();
  EXPECT_EQ(sum + source->sweeps().size(), static_cast<std::size_t>(3 * kBagSweeps));
  EXPECT_LE(most, 4U);
}

TEST(BagSweeps, ContinueAfterTheEndOfABag) {
  const TemporaryFolder folder;
  writeSweepBag(folder.file("a.bag"), {}, 0, 10);
  writeSweepBag(folder.file("b.bag"), {}, 10, kBagSweeps);  // without tf, which the first bag holds
  const std::vector<std::string> both = {folder.file("a.bag"), folder.file("b.bag")};
  const std::unique_ptr<Source> source = openSource(both, sweepOptions());
  std::shared_ptr<const BagEnd> end;
  while (const std::optional<SourceItem> item = source->next())
    if (item->bag_end && !end) end = item->bag_end;
  ASSERT_TRUE(end);
  const SweepReading whole = readSweepBag(both);
  for (const std::vector<std::string>& paths : {both, std::vector<std::string>{both[1]}}) {
    BagEnd after = *end;
    if (paths.size() == 1) after.bags = 0;
    const SweepReading rest = readSweepBag(paths, sweepOptions(), &after);
    ASSERT_EQ(rest.sweeps.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
      const Sweep &a = rest.sweeps[i].sweep, &b = whole.sweeps[10 + i].sweep;
      EXPECT_EQ(a.reference, b.reference);
      ASSERT_EQ(a.beams.size(), b.beams.size());
      EXPECT_EQ(a.beams.back().stamp, b.beams.back().stamp);
      EXPECT_EQ(rest.sweeps[i].T_base_lidar.t(), whole.sweeps[10 + i].T_base_lidar.t());
    }
    EXPECT_EQ(rest.kinds, whole.kinds);
  }
}

TEST(BagSweeps, WithoutTransformAreAtBaseLinkOrNotUsed) {
  const TemporaryFolder folder;
  SweepRecipe recipe;
  recipe.has_tf = false;
  writeSweepBag(folder.file("a.bag"), recipe);
  const SweepReading alone = readSweepBag({folder.file("a.bag")});
  EXPECT_EQ(alone.sweeps.size(), static_cast<std::size_t>(kBagSweeps));
  EXPECT_NE(alone.notes.find("no static tf from base_link to \"velodyne\": base_link is assumed"), std::string::npos)
      << alone.notes;
  recipe.has_images = true;
  writeSweepBag(folder.file("b.bag"), recipe);
  const SweepReading with_images = readSweepBag({folder.file("b.bag")});
  EXPECT_TRUE(with_images.sweeps.empty());
  EXPECT_NE(with_images.notes.find("/points_raw is not used"), std::string::npos) << with_images.notes;
}

TEST(BagSweeps, TheUserNamesTopicAndTimes) {
  const TemporaryFolder folder;
  SweepRecipe recipe;
  recipe.topic = "/fused/map";
  writeSweepBag(folder.file("a.bag"), recipe);
  SourceOptions options = sweepOptions();
  EXPECT_THROW(openSource({folder.file("a.bag")}, options), urban_nav_core::DataError) << "by its name a map";
  options.topics = {"points0:=/fused/map"};
  EXPECT_EQ(readSweepBag({folder.file("a.bag")}, options).sweeps.size(), static_cast<std::size_t>(kBagSweeps));
  options.points.times = urban_nav_core::PointTimes();
  EXPECT_EQ(readSweepBag({folder.file("a.bag")}, options).sweeps.front().sweep.times, Sweep::Times::Unknown);
  options.points.times = urban_nav_core::parsePointTimes("stamp,s,absolute");
  try {
    openSource({folder.file("a.bag")}, options);
    ADD_FAILURE();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("x, y, z, intensity, ring, time"), std::string::npos) << error.what();
  }
}

struct BadSweeps {
  const char* name;
  SweepRecipe recipe;
  const char* kind;
  const char* word;  ///< in the text
};
std::ostream& operator<<(std::ostream& out, const BadSweeps& bad) { return out << bad.name; }

SweepRecipe changed(std::function<bool(int, std::vector<BagPoint>&)> change) {
  SweepRecipe recipe;
  recipe.change = std::move(change);
  return recipe;
}
/// Changes each point of all sweeps.
SweepRecipe everyPoint(const std::function<void(BagPoint&)>& change) {
  return changed([change](int, std::vector<BagPoint>& points) {
    std::for_each(points.begin(), points.end(), change);
    return true;
  });
}
bool setNan(std::vector<BagPoint>& points) {
  for (BagPoint& point : points) point.x = point.y = point.z = NAN;
  return true;
}

std::vector<BadSweeps> badSweeps() {
  SweepRecipe overlapping;
  overlapping.period = 0.05;
  SweepRecipe two_clocks;
  two_clocks.has_images = true;
  two_clocks.clock = [](int) { return 3.0; };
  return {{"constant", everyPoint([](BagPoint& point) { point.time = 0.0F; }), "sweep_times", "same time"},
          {"decreasing", changed([](int, std::vector<BagPoint>& points) {
             for (std::size_t i = 0; i < points.size() / 2; ++i)
               std::swap(points[i].time, points[points.size() - 1 - i].time);
             return true;
           }),
           "sweep_times", "decrease"},
          {"milliseconds", everyPoint([](BagPoint& point) { point.time *= 1000.0F; }), "sweep_times", "unit ms"},
          {"no_times", everyPoint([](BagPoint& point) { point.time *= 1e-4F; }), "sweep_times", "without times"},
          {"overlapping", overlapping, "sweep_overlap", "overlap"},
          {"lost", changed([](int i, std::vector<BagPoint>&) { return i < 8 || i > 10; }), "sweep_gap", "gap"},
          {"few", changed([](int, std::vector<BagPoint>& points) {
             for (std::size_t i = 0; i < 500; ++i) points[i] = points[11 * i];
             points.resize(500);
             return true;
           }),
           "points_few", "few points"},
          {"some_nan", changed([](int i, std::vector<BagPoint>& points) { return i % 5 != 3 || setNan(points); }),
           "points_invalid", "NaN"},
          {"hood", everyPoint([](BagPoint& point) {
             if (point.y > 0.0F) point.x *= 0.03F, point.y *= 0.03F, point.z *= 0.03F;
           }),
           "points_near", "within 0.5 m"},
          {"firing_order",
           everyPoint([](BagPoint& point) { point.ring = static_cast<std::uint16_t>(5 * point.ring % 16); }),
           "ring_order", "elevation"},
          {"rings_missing", changed([](int, std::vector<BagPoint>& points) {
             points.erase(std::remove_if(points.begin(), points.end(),
                                         [](const BagPoint& p) { return p.ring == 4 || p.ring == 9; }),
                          points.end());
             return true;
           }),
           "ring_order", "4, 9"},
          {"two_clocks", two_clocks, "clock_apart", "clock"}};
}

class BadSweepsTest : public ::testing::TestWithParam<BadSweeps> {};

TEST_P(BadSweepsTest, AreNamedAndRead) {
  const TemporaryFolder folder;
  const BadSweeps& bad = GetParam();
  writeSweepBag(folder.file("a.bag"), bad.recipe);
  const SweepReading reading = readSweepBag({folder.file("a.bag")});
  EXPECT_NE(reading.kinds.find(bad.kind), std::string::npos) << reading.kinds << reading.texts;
  EXPECT_NE(reading.texts.find(bad.word), std::string::npos) << reading.texts;
  EXPECT_GE(reading.sweeps.size(), 10U);
  for (const SweepInput& input : reading.sweeps)
    for (const urban_nav_core::Beam& beam : input.sweep.beams) ASSERT_TRUE(std::isfinite(beam.range));
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, BadSweepsTest, ::testing::ValuesIn(badSweeps()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(BagSweeps, WithoutAnyValidPointAreUnusable) {
  const TemporaryFolder folder;
  writeSweepBag(folder.file("a.bag"), changed([](int, std::vector<BagPoint>& points) { return setNan(points); }));
  try {
    openSource({folder.file("a.bag")}, sweepOptions());
    ADD_FAILURE();
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("NaN"), std::string::npos) << error.what();
  }
  const Diagnosis diagnosis = examine({{folder.file("a.bag")}}, sweepOptions(), [](std::int64_t, std::int64_t) {});
  EXPECT_FALSE(diagnosis.isUsable());
  ASSERT_FALSE(diagnosis.findings.empty());
  EXPECT_STREQ(toString(diagnosis.findings.front().kind), "points_invalid");
}

TEST(BagSweeps, TheOptionsOfTheUnitRepairIt) {
  const TemporaryFolder folder;
  writeSweepBag(folder.file("a.bag"), {});
  SourceOptions options = sweepOptions();
  options.points.times = urban_nav_core::parsePointTimes("time,us,header");
  const std::unique_ptr<Source> source = openSource({folder.file("a.bag")}, options);
  while (source->next()) continue;
  const std::vector<Finding> findings = source->sensorFindings();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].options, (std::vector<std::string>{"--set", "input.points_time=auto"}));
}

/// A message of Livox in CDR: 1000 points in 0.1 s.
std::string livoxMessage(int i) {
  std::string bytes({char(0), char(1), char(0), char(0)});
  const auto put = [&bytes](auto value) {
    while ((bytes.size() - 4) % sizeof(value) != 0) bytes += char(0);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put(std::uint32_t{1'500'000'000} + static_cast<std::uint32_t>(i / 10));
  put(static_cast<std::uint32_t>(i % 10 * 100'000'000));
  put(std::uint32_t{6});
  bytes += std::string("livox") + char(0);
  put(std::uint64_t{0});
  put(std::uint32_t{1000});
  put(std::uint32_t{0});
  put(std::uint32_t{1000});
  for (std::uint32_t k = 0; k < 1000; ++k) {
    put(100'000 * k);
    put(5.0F + 0.001F * static_cast<float>(k));
    put(0.01F * static_cast<float>(k % 100));
    put(0.1F * static_cast<float>(k % 6));
    put(std::uint8_t{77});
    put(std::uint8_t{0});
    put(static_cast<std::uint8_t>(k % 6));
  }
  return bytes;
}

TEST(BagSweeps, OfLivoxAreReadByTheirOwnMessage) {
  const TemporaryFolder folder;
  const std::string definition =
      "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\nCustomPoint[] "
      "points\n" +
      std::string(80, '=') + "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +
      std::string(80, '=') +
      "\nMSG: livox_ros_driver2/CustomPoint\nuint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 "
      "reflectivity\nuint8 tag\nuint8 line\n";
  {
    McapWriter writer(folder.file("a.mcap"));
    const std::uint16_t channel =
        writer.addChannel({"/livox/lidar", "livox_ros_driver2/msg/CustomMsg", "ros2msg", definition, "cdr", {}});
    for (int i = 0; i < kBagSweeps; ++i) {
      const std::string message = livoxMessage(i);
      writer.write(channel, static_cast<StampNs>(1e9 * kFirstSweep) + 100'000'000 * i + 110'000'000,
                   {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()});
    }
    writer.commit();
  }
  const SweepReading reading = readSweepBag({folder.file("a.mcap")});
  ASSERT_EQ(reading.sweeps.size(), static_cast<std::size_t>(kBagSweeps));
  EXPECT_EQ(printPointTimes(reading.inputs.at(0).lidar->times), "offset_time,ns,header");
  EXPECT_EQ(reading.inputs[0].frame, "livox");
  const Sweep& sweep = reading.sweeps[3].sweep;
  EXPECT_EQ(sweep.beams.size(), 1000U);
  EXPECT_EQ(sweep.beams.front().stamp, static_cast<StampNs>(1e9 * kFirstSweep) + 300'000'000);
  EXPECT_EQ(sweep.beams.back().stamp - sweep.beams.front().stamp, 99'900'000);
  EXPECT_FLOAT_EQ(sweep.beams.front().intensity, 77.0F);
}

TEST(BagSweeps, OfTwoLidarsComeInTheOrderOfTheirReferences) {
  const TemporaryFolder folder;
  writeSweepBag(folder.file("a.bag"), {});
  {
    rosbag::Bag bag(folder.file("a.bag"), rosbag::bagmode::Append);
    tf2_msgs::TFMessage transforms;
    transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "rear", urban_nav_core::Pose()));
    bag.write("/tf_static", ros::Time(kFirstSweep), transforms);
    for (int i = 0; i < kBagSweeps; ++i)
      bag.write("/rear/points", ros::Time(kFirstSweep + kSweepPeriod * i + 0.3),
                toCloud(sweepPoints(), kFirstSweep + kSweepPeriod * i + 0.02, "rear"));
  }
  const SweepReading reading = readSweepBag({folder.file("a.bag")});
  ASSERT_EQ(reading.sweeps.size(), static_cast<std::size_t>(2 * kBagSweeps));
  EXPECT_TRUE(
      std::is_sorted(reading.sweeps.begin(), reading.sweeps.end(),
                     [](const SweepInput& a, const SweepInput& b) { return a.sweep.reference < b.sweep.reference; }));
  EXPECT_EQ(reading.sweeps[0].role, "points0");
  EXPECT_EQ(reading.sweeps[1].role, "points1");
}

}  // namespace
}  // namespace urban_nav_input
