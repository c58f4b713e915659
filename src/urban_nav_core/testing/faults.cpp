// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

struct Entry {
  FaultKind kind;
  const char* name;
  double standard, low, high;  ///< value: default and allowed range
};

constexpr double kFarFuture = 1e9;  // s
const std::array<Entry, 12> kFaults{{{FaultKind::Black, "black", 0.0, 0.0, 0.0},
                                     {FaultKind::Freeze, "freeze", 0.0, 0.0, 0.0},
                                     {FaultKind::Swap, "swap", 0.0, 0.0, 0.0},
                                     {FaultKind::Drop, "drop", 1.0, 0.0, 1.0},
                                     {FaultKind::OverExpose, "overexpose", 4.0, 0.0, 1000.0},
                                     {FaultKind::Blur, "blur", 4.0, 0.1, 100.0},
                                     {FaultKind::Corrupt, "corrupt", 0.3, 0.0, 1.0},
                                     {FaultKind::NoLeft, "noleft", 0.0, 0.0, 0.0},
                                     {FaultKind::NoRight, "noright", 0.0, 0.0, 0.0},
                                     {FaultKind::StampJump, "jump", 10.0, -kFarFuture, kFarFuture},
                                     {FaultKind::StampEqual, "equal", 0.0, 0.0, 0.0},
                                     {FaultKind::StampBackward, "backward", 0.0, 0.0, 0.0}}};

const Entry& entry(FaultKind kind) {
  return *std::find_if(kFaults.begin(), kFaults.end(), [kind](const Entry& e) { return e.kind == kind; });
}

std::uint64_t mixed(std::uint64_t z) {  // SplitMix64
  z *= 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

void expose(GreyImage& image, double factor) {
  for (std::uint8_t& pixel : image.pixels)
    pixel = static_cast<std::uint8_t>(std::lround(std::clamp(pixel * factor, 0.0, 255.0)));
}

void blur(GreyImage& image, double sigma) {
  if (image.pixels.empty()) return;
  cv::Mat pixels(image.height, image.width, CV_8U, image.pixels.data());
  cv::GaussianBlur(pixels, pixels, cv::Size(), sigma);
}

void corruptRows(GreyImage& image, double share, std::uint64_t seed) {
  for (int v = 0; v < image.height && !image.pixels.empty(); ++v) {
    const std::uint64_t row = mixed(seed + static_cast<std::uint64_t>(v));
    if (static_cast<double>(row >> 32U) >= share * 4294967296.0) continue;
    for (int u = 0; u < image.width; ++u) {
      image.pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(u)] =
          static_cast<std::uint8_t>(mixed(row + static_cast<std::uint64_t>(u)) & 255U);
    }
  }
}

}  // namespace

bool Fault::isActive(StampNs since_first) const {
  const StampNs start = std::llround(start_s * 1e9);
  return since_first >= start && since_first < start + std::llround(duration_s * 1e9);
}

const char* toString(FaultKind kind) { return entry(kind).name; }

Fault parseFault(const std::string& text) {
  std::string names;
  for (const Entry& e : kFaults) names += std::string(names.empty() ? "" : ", ") + e.name;
  const auto refuse = [&](const std::string& allowed) { throw UserError("fault", text, allowed); };
  const std::vector<std::string_view> parts = splitAt(text, ':');
  if (parts.size() < 3 || parts.size() > 4) refuse("KIND:START_S:DURATION_S[:VALUE], KIND " + names);
  const auto known = std::find_if(kFaults.begin(), kFaults.end(), [&](const Entry& e) { return parts[0] == e.name; });
  if (known == kFaults.end()) refuse("KIND " + names);
  const std::optional<double> start = parseNumber(parts[1]), duration = parseNumber(parts[2]);
  if (!start || !duration || !(*start >= 0.0) || !(*duration > 0.0)) refuse("start >= 0 and duration > 0 (s)");
  Fault fault{known->kind, *start, *duration, std::nullopt};
  if (parts.size() == 4) {
    fault.value = parseNumber(parts[3]);
    if (known->low == known->high) refuse(std::string("no value for ") + known->name);
    if (!fault.value || *fault.value < known->low || *fault.value > known->high) {
      refuse("value " + printNumber(known->low) + "..." + printNumber(known->high));
    }
  }
  return fault;
}

FaultFilter::FaultFilter(std::vector<Fault> faults, std::uint32_t seed) : faults_(std::move(faults)), seed_(seed) {}

double FaultFilter::chance(std::uint64_t what) const {
  const std::uint64_t bits = mixed(mixed((static_cast<std::uint64_t>(seed_) << 32U) + count_) + what);
  return static_cast<double>(bits >> 11U) / 9007199254740992.0;
}

bool FaultFilter::spoil(const Fault& fault, const StereoFrame& original, StereoFrame& frame) const {
  const double value = fault.value.value_or(entry(fault.kind).standard);
  const std::uint64_t seed = mixed((static_cast<std::uint64_t>(seed_) << 32U) + count_);
  switch (fault.kind) {
    case FaultKind::Black:
      std::fill(frame.left.pixels.begin(), frame.left.pixels.end(), std::uint8_t{0});
      std::fill(frame.right.pixels.begin(), frame.right.pixels.end(), std::uint8_t{0});
      break;
    case FaultKind::Freeze:
      frame.left = last_good_.left;
      frame.right = last_good_.right;
      break;
    case FaultKind::Swap: std::swap(frame.left, frame.right); break;
    case FaultKind::Drop: return chance(1) >= value;
    case FaultKind::OverExpose:
      expose(frame.left, value);
      expose(frame.right, value);
      break;
    case FaultKind::Blur:
      blur(frame.left, value);
      blur(frame.right, value);
      break;
    case FaultKind::Corrupt:
      corruptRows(frame.left, value, seed);
      corruptRows(frame.right, value, seed + 1'000'000);
      break;
    case FaultKind::NoLeft: frame.left = GreyImage{}; break;
    case FaultKind::NoRight: frame.right = GreyImage{}; break;
    case FaultKind::StampJump: frame.stamp += std::llround(value * 1e9); break;
    case FaultKind::StampEqual: frame.stamp = last_good_.stamp; break;
    case FaultKind::StampBackward: frame.stamp = 2 * last_good_.stamp - original.stamp; break;
  }
  return true;
}

std::optional<StereoFrame> FaultFilter::apply(const StereoFrame& frame) {
  if (!first_stamp_) {
    first_stamp_ = frame.stamp;
    last_good_ = frame;  // a fault at the first frame has no frame before it
  }
  const StampNs since_first = frame.stamp - *first_stamp_;
  StereoFrame spoilt = frame;
  bool arrives = true, good = true;
  for (const Fault& fault : faults_) {
    if (!fault.isActive(since_first)) continue;
    good = false;
    arrives = spoil(fault, frame, spoilt) && arrives;
  }
  if (good) last_good_ = frame;
  ++count_;
  if (!arrives) return std::nullopt;
  return spoilt;
}

}  // namespace urban_nav_core::testing
