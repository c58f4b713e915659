// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "segway_drivers/xsens_mti/sample.hpp"
#include "xsens_mti/number_format.hpp"
#include "xsens_mti/orientation.hpp"

namespace segway_drivers {

namespace {

/// Reads numbers in order. Records reads beyond the end and non-finite numbers.
class MtiDataReader {
 public:
  MtiDataReader(ByteView data, unsigned format) : data_(data), format_(format) {}

  double number() {
    const double value =
        take(mtiNumberSize(format_)) ? readMtiNumber(data_.data + at_ - mtiNumberSize(format_), format_) : 0;
    good_ = good_ && std::isfinite(value);
    return value;
  }
  MtiSample::Vector vector() {
    MtiSample::Vector v{};
    for (double& each : v) each = number();
    return v;
  }
  std::uint16_t word() { return take(2) ? bigWord(data_.data + at_ - 2) : std::uint16_t{0}; }
  bool take(std::size_t size) {
    if (data_.size - at_ < size) good_ = false;
    else at_ += size;
    return good_;
  }
  bool good() const { return good_ && at_ == data_.size; }

 private:
  ByteView data_;
  unsigned format_;
  std::size_t at_ = 0;
  bool good_ = true;
};

bool hasBit(unsigned word, unsigned bit) { return (word >> bit & 1U) != 0; }

std::array<double, 4> readMtiDataOrientation(MtiDataReader& reader, unsigned kind) {
  if (kind == 0) {
    std::array<double, 4> q{};
    for (double& each : q) each = reader.number();
    return q;
  }
  if (kind == 1) {
    const auto euler = reader.vector();
    return mtiQuaternionFromEuler(euler[0], euler[1], euler[2]);
  }
  std::array<double, 9> matrix{};
  for (double& each : matrix) each = reader.number();
  return mtiQuaternionFromMatrix(matrix);
}

}  // namespace

std::optional<std::size_t> mtiDataLength(unsigned mode, unsigned settings) {
  const std::size_t tail = (settings & 3U) == 1 ? 2 : 0;
  if (hasBit(mode, 14)) return 20 + tail;  // raw values only
  if ((settings & 3U) > 1 || (settings >> 2 & 3U) == 3 || (mode & 0x0030U) != 0) return std::nullopt;
  std::size_t numbers = hasBit(mode, 0) ? 1 : 0, bytes = 0;
  if (hasBit(mode, 1))
    for (const unsigned bit : {4U, 5U, 6U}) numbers += hasBit(settings, bit) ? 0 : 3;
  if (hasBit(mode, 2)) numbers += (settings >> 2 & 3U) == 0 ? 4 : (settings >> 2 & 3U) == 1 ? 3 : 9;
  if (hasBit(mode, 3))
    for (const unsigned bit : {10U, 11U}) bytes += hasBit(settings, bit) ? 0 : 2;
  bytes += hasBit(mode, 11) ? 1 : 0;
  return numbers * mtiNumberSize(settings >> 8) + bytes + tail;
}

std::optional<MtiSample> decodeMtiData(ByteView data, unsigned mode, unsigned settings) {
  const auto length = mtiDataLength(mode, settings);
  if (!length || *length != data.size) return std::nullopt;
  MtiSample sample;
  if ((mode >> 31 & 1U) != 0 || (settings >> 31 & 1U) != 0) sample.earth = MtiSample::Earth::Ned;
  MtiDataReader reader(data, settings >> 8);
  if (hasBit(mode, 14)) {
    reader.take(20);
  } else {
    if (hasBit(mode, 0)) sample.temperature = reader.number();
    if (hasBit(mode, 1) && !hasBit(settings, 4)) sample.acceleration = reader.vector();
    if (hasBit(mode, 1) && !hasBit(settings, 5)) sample.rate = reader.vector();
    if (hasBit(mode, 1) && !hasBit(settings, 6)) sample.field = reader.vector();
    if (hasBit(mode, 2)) sample.orientation = readMtiDataOrientation(reader, settings >> 2 & 3U);
    if (hasBit(mode, 3) && !hasBit(settings, 10)) reader.word();
    if (hasBit(mode, 3) && !hasBit(settings, 11)) reader.word();
    if (hasBit(mode, 11)) reader.take(1);
  }
  if ((settings & 3U) == 1) sample.counter = reader.word();
  return reader.good() ? std::optional<MtiSample>(sample) : std::nullopt;
}

}  // namespace segway_drivers
