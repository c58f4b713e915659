// SPDX-License-Identifier: BSD-3-Clause
// Free of ROS: compiled under the sanitizers too.
#include "urban_nav_core/laser/cloud/livox.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace urban_nav_core {
namespace {

constexpr int kLivoxPoints = 400;

/// Writes numbers as one of the encodings does.
class Bytes {
 public:
  explicit Bytes(LivoxEncoding encoding) : encoding_(encoding) {
    if (encoding_ != LivoxEncoding::Ros1)
      text_ = {char(0), char(encoding == LivoxEncoding::Cdr ? 1 : 0), char(0), char(0)};
  }
  template <typename T>
  Bytes& number(T value) {
    while (encoding_ != LivoxEncoding::Ros1 && (text_.size() - 4) % sizeof(T) != 0) text_ += char(0);
    std::string bytes(sizeof(T), char(0));
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (encoding_ == LivoxEncoding::CdrBigEndian) bytes.assign(bytes.rbegin(), bytes.rend());
    text_ += bytes;
    return *this;
  }
  Bytes& frame(const std::string& name) {
    const bool is_cdr = encoding_ != LivoxEncoding::Ros1;
    number(static_cast<std::uint32_t>(name.size() + (is_cdr ? 1 : 0)));
    text_ += name;
    if (is_cdr) text_ += char(0);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  LivoxEncoding encoding_;
  std::string text_;
};

std::string makeMessage(LivoxEncoding encoding) {
  Bytes bytes(encoding);
  if (encoding == LivoxEncoding::Ros1) bytes.number(std::uint32_t{7});
  bytes.number(std::uint32_t{1'600'000'000}).number(std::uint32_t{500}).frame("livox_frame");
  bytes.number(std::uint64_t{123'456'789}).number(std::uint32_t{kLivoxPoints}).number(std::uint32_t{0});
  bytes.number(std::uint32_t{kLivoxPoints});
  for (int i = 0; i < kLivoxPoints; ++i) {
    bytes.number(static_cast<std::uint32_t>(250'000 * i)).number(5.0F + 0.01F * static_cast<float>(i));
    bytes.number(1.0F).number(-0.5F).number(std::uint8_t{200}).number(std::uint8_t{16});
    bytes.number(static_cast<std::uint8_t>(i % 6));
  }
  return bytes.text();
}

const std::uint8_t* toBytes(const std::string& text) { return reinterpret_cast<const std::uint8_t*>(text.data()); }

class LivoxEncodings : public ::testing::TestWithParam<LivoxEncoding> {};

TEST_P(LivoxEncodings, PointsAreReadByTheirTimes) {
  const std::string text = makeMessage(GetParam());
  const std::optional<LivoxCloud> cloud = parseLivox(toBytes(text), text.size(), GetParam());
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->frame, "livox_frame");
  EXPECT_EQ(cloud->view.stamp, 1'600'000'000'000'000'500);
  CloudSurvey survey;
  survey.add(cloud->view);
  const CloudConvention convention = survey.conclude();
  EXPECT_EQ(printPointTimes(convention.times), "offset_time,ns,header");
  const ReadSweep read = SweepReader(convention, {}).read(cloud->view);
  EXPECT_EQ(read.missing, 0U);
  ASSERT_EQ(read.sweep.beams.size(), static_cast<std::size_t>(kLivoxPoints));
  const Beam& last = read.sweep.beams.back();
  EXPECT_EQ(last.stamp, cloud->view.stamp + 250'000 * (kLivoxPoints - 1));
  EXPECT_NEAR(last.range, std::sqrt(8.99F * 8.99F + 1.25F), 1e-4F);
  EXPECT_FLOAT_EQ(last.intensity, 200.0F);
}

INSTANTIATE_TEST_SUITE_P(AllOf, LivoxEncodings,
                         ::testing::Values(LivoxEncoding::Ros1, LivoxEncoding::Cdr, LivoxEncoding::CdrBigEndian));

TEST(LivoxTest, MessagesThatEndTooEarlyAreNotRead) {
  const std::string text = makeMessage(LivoxEncoding::Ros1);
  EXPECT_FALSE(parseLivox(toBytes(text), 40, LivoxEncoding::Ros1));
  const std::optional<LivoxCloud> cut = parseLivox(toBytes(text), text.size() - 19 * 10 - 1, LivoxEncoding::Ros1);
  ASSERT_TRUE(cut);
  EXPECT_EQ(CloudPoints(cut->view).missing(), 11U);
}

TEST(LivoxTest, DamagedMessages) {
  for (const LivoxEncoding encoding : {LivoxEncoding::Ros1, LivoxEncoding::Cdr, LivoxEncoding::CdrBigEndian}) {
    const auto read = [encoding](const std::string& text) {
      const std::optional<LivoxCloud> cloud = parseLivox(toBytes(text), text.size(), encoding);
      if (cloud) SweepReader({}, {}).read(cloud->view);
    };
    EXPECT_EQ(testing::fuzzText({makeMessage(encoding)}, read).failure.substr(0, 300), "");
  }
}

}  // namespace
}  // namespace urban_nav_core
