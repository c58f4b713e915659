// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/driver.hpp"

#include <algorithm>
#include <array>

#include "segway_drivers/gps/gpsd.hpp"

namespace segway_drivers {

namespace {

constexpr std::array<int, 4> kGpsRates = {9600, 4800, 38400, 115200};
constexpr TimeNs kGpsLoss = 2'500'000'000, kGpsReopen = 10'000'000'000;  // ns
constexpr int kGpsProof = 2;                                             // messages with a correct checksum

}  // namespace

GpsDriver::GpsDriver(const Options& options) : options_(options), stream_(options.stream) {
  stream_.on_fix = [this](const GpsFix& fix, std::optional<TimeNs> stamp) {
    if (on_fix) on_fix(fix, stamp);
  };
  stream_.on_message = [this](const std::string& kind) {
    last_message_ = now_;
    if (kinds_.size() < 50 && kinds_.insert(kind).second) {
      std::string all;
      for (const std::string& each : kinds_) all += (all.empty() ? "" : " ") + each;
      setIdentity(all);
    }
    if (++messages_ >= kGpsProof) setState(DriverState::Streaming);
  };
}

void GpsDriver::begin(TimeNs now) {
  now_ = now;
  stream_.clear();
  if (options_.gpsd) {
    last_message_ = now;
    messages_ = 0;
    write(makeGpsdWatch());
    setState(DriverState::Identifying);
  } else {
    tryRate(now);
  }
}

void GpsDriver::tryRate(TimeNs now) {
  setBaud(kGpsRates[rate_]);
  stream_.setBaud(kGpsRates[rate_]);
  stream_.clear();
  messages_ = 0;
  last_message_ = now;
  setState(DriverState::Identifying);
}

void GpsDriver::feed(ByteView chunk, const ChunkArrival& arrival) {
  now_ = std::max(now_, arrival.time);
  stream_.feed(chunk, arrival);
}

void GpsDriver::tick(TimeNs now) {
  now_ = now;
  stream_.expire(now);
  const TimeNs silent = now - last_message_;
  if (state() == DriverState::Streaming && silent > kGpsLoss) setState(DriverState::Stalled, "no sentence for 2.5 s");
  if (state() == DriverState::Stalled && silent > kGpsReopen) {
    last_message_ = now;
    reopen();
  }
  if (state() == DriverState::Identifying && silent > kGpsLoss) {
    countTimeout();
    if (options_.gpsd) {
      last_message_ = now;
      reopen();
      return;
    }
    rate_ = (rate_ + 1) % kGpsRates.size();
    tryRate(now);
  }
}

}  // namespace segway_drivers
