// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "segway_drivers/xsens_mti/sample.hpp"
#include "xsens_mti/number_format.hpp"
#include "xsens_mti/orientation.hpp"

namespace segway_drivers {

namespace {

/// Reads `count` numbers of an item. Returns false for another size or non-finite numbers.
template <std::size_t count>
bool readMtiItem(ByteView data, unsigned format, std::array<double, count>& numbers) {
  const std::size_t size = mtiNumberSize(format);
  if (data.size != count * size) return false;
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] = readMtiNumber(data.data + i * size, format);
    if (!std::isfinite(numbers[i])) return false;
  }
  return true;
}

bool readMtiVector(ByteView data, unsigned format, std::optional<MtiSample::Vector>& vector) {
  MtiSample::Vector numbers{};
  if (!readMtiItem(data, format, numbers)) return false;
  vector = numbers;
  return true;
}

bool readMtiScalar(ByteView data, unsigned format, std::optional<double>& value) {
  std::array<double, 1> number{};
  if (!readMtiItem(data, format, number)) return false;
  value = number[0];
  return true;
}

bool readMtiOrientation(unsigned kind, ByteView data, unsigned format, MtiSample& sample) {
  if (kind == 0x2010) {
    std::array<double, 4> q{};
    if (!readMtiItem(data, format, q)) return false;
    sample.orientation = q;
  } else if (kind == 0x2020) {
    std::array<double, 9> matrix{};
    if (!readMtiItem(data, format, matrix)) return false;
    if (!sample.orientation) sample.orientation = mtiQuaternionFromMatrix(matrix);
  } else {
    std::array<double, 3> euler{};
    if (!readMtiItem(data, format, euler)) return false;
    if (!sample.orientation) sample.orientation = mtiQuaternionFromEuler(euler[0], euler[1], euler[2]);
  }
  return true;
}

bool readMtiPosition(ByteView data, unsigned format, MtiSample& sample) {
  std::array<double, 2> position{};
  if (!readMtiItem(data, format, position)) return false;
  sample.latitude = position[0];
  sample.longitude = position[1];
  return true;
}

/// Returns false for an item of a known kind with a wrong size.
bool readMtiKnownItem(unsigned identifier, ByteView data, MtiSample& sample) {
  const unsigned kind = identifier & 0xFFF0U, format = identifier & 3U, frame = identifier >> 2 & 3U;
  switch (kind) {
    case 0x0810: return readMtiScalar(data, format, sample.temperature);
    case 0x1020:
      if (data.size != 2) return false;
      sample.counter = bigWord(data.data);
      return true;
    case 0x1060:
      if (data.size != 4) return false;
      sample.sample_time_fine = bigWord32(data.data);
      return true;
    case 0x2010:
    case 0x2020:
    case 0x2030:
      sample.earth = frame == 1 ? MtiSample::Earth::Ned : frame == 2 ? MtiSample::Earth::Nwu : MtiSample::Earth::Enu;
      return readMtiOrientation(kind, data, format, sample);
    case 0x3010:
      if (data.size != 4) return false;
      sample.pressure = bigWord32(data.data);
      return true;
    case 0x4020: return readMtiVector(data, format, sample.acceleration);
    case 0x5020: return readMtiScalar(data, format, sample.height);
    case 0x5040: return readMtiPosition(data, format, sample);
    case 0x8020: return readMtiVector(data, format, sample.rate);
    case 0xC020: return readMtiVector(data, format, sample.field);
    default: return true;
  }
}

}  // namespace

std::optional<MtiSample> decodeMtiData2(ByteView data) {
  MtiSample sample;
  sample.earth = MtiSample::Earth::Enu;
  std::size_t at = 0;
  while (at < data.size) {
    if (data.size - at < 3) return std::nullopt;
    const std::size_t size = data[at + 2];
    if (data.size - at - 3 < size) return std::nullopt;
    if (!readMtiKnownItem(bigWord(data.data + at), data.sub(at + 3, size), sample)) return std::nullopt;
    at += 3 + size;
  }
  return sample;
}

}  // namespace segway_drivers
