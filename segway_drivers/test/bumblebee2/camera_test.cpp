// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/bumblebee2/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace segway_drivers {
namespace {

/// A camera with registers and a bus clock that wraps; 12 px of disparity.
class SimulatedBus : public FrameSource {
 public:
  explicit SimulatedBus(Bb2Embedding embedding) : embedding_(embedding) {
    cv::Mat noise(kBb2Height / 4, kBb2Width / 4 + 8, CV_8U), scene;
    cv::RNG random(3);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    cv::resize(noise, scene, {}, 4.0, 4.0, cv::INTER_CUBIC);
    left_ = scene(cv::Rect(0, 0, kBb2Width, kBb2Height)).clone();
    right_ = scene(cv::Rect(12, 0, kBb2Width, kBb2Height)).clone();
  }
  bool open(std::string&) override { return true; }
  std::optional<std::uint32_t> readRegister(std::uint64_t address) override { return registers_[address]; }
  bool writeRegister(std::uint64_t address, std::uint32_t value) override {
    registers_[address] = value;
    return true;
  }
  bool start(const CameraFormat&, std::string&) override { return true; }
  std::optional<CameraFrame> next(TimeNs) override {
    time_s += 0.05;
    cv::Mat left = left_.clone(), right = right_.clone();
    const Bytes words = makeWords();
    if (embedding_ == Bb2Embedding::Imager)
      for (std::size_t i = 0; i < words.size(); ++i) left.data[i] = right.data[i] = words[i];
    const bool swapped = registers_[0x1048] != 0x80000000;
    cv::Mat both;
    cv::merge(std::vector<cv::Mat>{swapped != reversed ? left : right, swapped != reversed ? right : left}, both);
    CameraFrame frame;
    frame.bytes.assign(both.data, both.data + kBb2FrameSize);
    if (embedding_ == Bb2Embedding::Raw) std::copy(words.begin(), words.end(), frame.bytes.begin());
    frame.corrupt = sequence % 10 == 7;
    ++sequence;
    return frame;
  }
  std::optional<CameraCycle> readCycle() override {
    return CameraCycle{std::fmod(time_s + 0.03, 128.0), static_cast<TimeNs>(std::llround(1e9 * (time_s + 0.03)))};
  }
  void stop() override {}
  bool isGone() const override { return false; }

  double time_s = 120.0;
  std::uint32_t sequence = 0;
  bool reversed = false;

 private:
  Bytes makeWords() const {
    const auto ticks = static_cast<std::uint64_t>(std::llround(time_s * 24.576e6)) % (128U * 24'576'000U);
    const auto seconds = static_cast<std::uint32_t>(ticks / 24'576'000U),
               cycle = static_cast<std::uint32_t>(ticks / 3072U % 8000U);
    const auto offset = static_cast<std::uint32_t>(ticks % 3072U) & 0xFF0U;
    Bytes words;
    appendBig32(words, seconds << 25 | cycle << 12 | offset);
    appendBig32(words, 0x82000123);
    appendBig32(words, 0x82000456);
    appendBig32(words, sequence);
    return words;
  }

  Bb2Embedding embedding_;
  cv::Mat left_, right_;
  std::map<std::uint64_t, std::uint32_t> registers_{{0x1F28, 0xA}, {0x1040, 0x59595959}};
};

TEST(Bb2Camera, StampsFollowTheBusOverItsWrapWhereverTheTimeIsEmbedded) {
  for (const Bb2Embedding embedding : {Bb2Embedding::Raw, Bb2Embedding::Imager}) {
    SimulatedBus bus(embedding);
    Bb2Camera camera(bus, Bb2Camera::Options{});
    std::string error;
    ASSERT_TRUE(camera.start(error)) << error;
    int pairs = 0, missing = 0;
    for (int i = 0; i < 240; ++i) {
      const auto pair = camera.next(0);
      if (!pair) continue;
      ++pairs;
      missing += pair->missing;
      EXPECT_NEAR(1e-9 * static_cast<double>(pair->stamp), bus.time_s, 2e-6);
    }
    EXPECT_GT(pairs, 205);
    EXPECT_EQ(camera.counters().bad_checksums, 24);
    EXPECT_EQ(missing, 24);
    EXPECT_TRUE(camera.takeEvents().empty());
  }
}

TEST(Bb2Camera, ExchangedImagersAreReported) {
  SimulatedBus bus(Bb2Embedding::Raw);
  bus.reversed = true;
  Bb2Camera camera(bus, Bb2Camera::Options{});
  std::string error;
  ASSERT_TRUE(camera.start(error));
  for (int i = 0; i < 20; ++i) camera.next(0);
  const auto events = camera.takeEvents();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NE(events[0].text.find("swap_images"), std::string::npos);
}

}  // namespace
}  // namespace segway_drivers
