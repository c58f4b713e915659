// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/lms291/driver.hpp"

#include <array>

#include "segway_drivers/lms291/commands.hpp"

namespace segway_drivers {

namespace {

constexpr std::array<int, 4> kLmsRates = {500000, 38400, 19200, 9600};
constexpr TimeNs kLmsListen = 100'000'000, kLmsFindTimeout = 200'000'000, kLmsSettle = 250'000'000;  // ns
constexpr TimeNs kLmsModeTimeout = 3'000'000'000, kLmsQueryTimeout = 400'000'000, kLmsFirstTimeout = 250'000'000,
                 kLmsRewriteTimeout = 15'000'000'000;
constexpr TimeNs kLmsSilence = 200'000'000;
constexpr int kLmsSoftRestarts = 3, kLmsRoundsPerOpening = 3;
constexpr std::uint8_t kLmsMode15Bits = 0x05, kLmsUnitMm = 0x01;

std::string textOfReply(ByteView payload) {
  std::string text;
  for (std::size_t i = 1; i + 1 < payload.size; ++i)
    if (payload[i] >= 0x20 && payload[i] < 0x7F) text += static_cast<char>(payload[i]);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

LmsDriver::LmsDriver(const Options& options) : options_(options), stream_(options.stream) {
  stream_.on_scan = [this](const LmsStampedScan& scan) { takeScan(scan); };
  stream_.on_reply = [this](ByteView payload) { takeReply(payload); };
}

void LmsDriver::begin(TimeNs now) {
  rounds_ = 0;
  enter(Phase::Listen, now);
}

void LmsDriver::enter(Phase phase, TimeNs now) {
  phase_ = phase;
  request_.stop();
  switch (phase) {
    case Phase::Listen:
      setBaud(kLmsRates[0]);
      stream_.setBaud(kLmsRates[0]);
      stream_.clear();
      deadline_ = now + kLmsListen;
      break;
    case Phase::Find: find(0); break;
    case Phase::Raise: request_.start(*lmsBaudCommand(kLmsRates[0]), kLmsModeTimeout); break;
    case Phase::Settle:
      setBaud(kLmsRates[0]);
      stream_.setBaud(kLmsRates[0]);
      stream_.clear();
      deadline_ = now + kLmsSettle;
      break;
    case Phase::Status: request_.start(lmsStatusCommand(), kLmsFirstTimeout); break;
    case Phase::Type: request_.start(lmsTypeCommand(), kLmsQueryTimeout); break;
    case Phase::Configuration: request_.start(lmsConfigurationCommand(), kLmsQueryTimeout); break;
    case Phase::Installation: request_.start(lmsInstallationCommand(), kLmsModeTimeout); break;
    case Phase::Rewrite: request_.start(lmsWriteConfigurationCommand(configuration_), kLmsRewriteTimeout, 1); break;
    case Phase::Start: request_.start(lmsStreamReflectivitiesCommand(), kLmsModeTimeout); break;
    case Phase::Stream:
      last_scan_ = now;
      setState(DriverState::Streaming);
      break;
  }
}

void LmsDriver::find(std::size_t rate) {
  rate_ = rate;
  setState(DriverState::Identifying);
  setBaud(kLmsRates[rate_]);
  stream_.setBaud(kLmsRates[rate_]);
  stream_.clear();
  request_.start(lmsStopCommand(), kLmsFindTimeout, 1);
}

void LmsDriver::tick(TimeNs now) {
  now_ = now;
  stream_.expire(now);
  switch (request_.due(now)) {
    case PendingRequest::Due::Send: write(request_.bytes()); break;
    case PendingRequest::Due::Failed: fail(); break;
    case PendingRequest::Due::Nothing: break;
  }
  if (phase_ == Phase::Listen && now >= deadline_) enter(Phase::Find, now);
  if (phase_ == Phase::Settle && now >= deadline_) enter(Phase::Status, now);
  if (phase_ == Phase::Stream) watch(now);
}

/// Handles a request without answer: tries the next rate, or restarts, and occasionally reopens the port.
void LmsDriver::fail() {
  countTimeout();
  if (phase_ == Phase::Find && rate_ + 1 < kLmsRates.size()) {
    find(rate_ + 1);
    return;
  }
  if (phase_ != Phase::Find)
    report(true, "no answer to " + printHex(request_.bytes()) + " at " + std::to_string(kLmsRates[rate_]) + " baud");
  if (++rounds_ < kLmsRoundsPerOpening) enter(Phase::Listen, now_);
  else reopen();
}

void LmsDriver::watch(TimeNs now) {
  if (now - last_scan_ < kLmsSilence) return;
  if (soft_restarts_ < kLmsSoftRestarts) {
    setState(DriverState::Stalled, "no scan for 0.2 s");
    ++soft_restarts_;
    last_scan_ = now;
    write(lmsStreamReflectivitiesCommand());
    return;
  }
  soft_restarts_ = 0;
  enter(Phase::Listen, now);
}

void LmsDriver::takeScan(const LmsStampedScan& scan) {
  if (phase_ == Phase::Listen) {
    report(false, "already streaming");
    enter(Phase::Stream, now_);
  }
  if (phase_ != Phase::Stream) return;
  last_scan_ = now_;
  soft_restarts_ = 0;
  setState(DriverState::Streaming);
  if (on_scan) on_scan(scan);
}

void LmsDriver::takeReply(ByteView payload) {
  const std::uint8_t code = payload[0];
  if (code == 0xA0 &&
      (phase_ == Phase::Find || phase_ == Phase::Raise || phase_ == Phase::Installation || phase_ == Phase::Start)) {
    takeModeReply(payload);
  } else if (code == 0xB1 && phase_ == Phase::Status) {
    takeStatus(payload);
  } else if (code == 0xBA && phase_ == Phase::Type) {
    takeType(payload);
  } else if (code == 0xF4 && phase_ == Phase::Configuration) {
    takeConfiguration(payload);
  } else if (code == 0xF7 && phase_ == Phase::Rewrite) {
    takeRewritten(payload);
  } else if (code == 0x90) {
    report(true, "restarted: " + textOfReply(payload));
    enter(Phase::Find, now_);
  } else if (code != 0xA0 || phase_ != Phase::Stream) {  // the answer to a soft restart is expected
    countUnexpected();
  }
}

void LmsDriver::takeModeReply(ByteView payload) {
  if (payload[1] != 0) {
    report(true, "mode rejected, code " + std::to_string(payload[1]));
    enter(Phase::Find, now_);
    return;
  }
  const bool fast = kLmsRates[rate_] == kLmsRates[0];
  switch (phase_) {
    case Phase::Find:
      setState(DriverState::Configuring);
      enter(fast ? Phase::Status : Phase::Raise, now_);
      break;
    case Phase::Raise:
      rate_ = 0;
      enter(Phase::Settle, now_);
      break;
    case Phase::Installation: enter(Phase::Rewrite, now_); break;
    default: enter(Phase::Stream, now_); break;
  }
}

void LmsDriver::takeStatus(ByteView payload) {
  if (payload.size > 9 && payload[9] != 0) report(true, "device reports an error: see its error list");
  enter(Phase::Type, now_);
}

void LmsDriver::takeType(ByteView payload) {
  setIdentity(textOfReply(payload));
  if (identity().find("S14") == std::string::npos)
    report(true, identity() + " is not an LMS291-S14: ranges with reflectivity may be rejected");
  enter(Phase::Configuration, now_);
}

void LmsDriver::takeConfiguration(ByteView payload) {
  configuration_.assign(payload.begin() + 1, payload.end() - 1);
  const auto format = LmsRangeFormat::fromConfiguration(configuration_[5], configuration_[6]);
  if (format && (format->millimetres || !options_.configure)) {
    stream_.setFormat(*format);
    enter(Phase::Start, now_);
    return;
  }
  if (options_.configure && !rewritten_) {
    rewritten_ = true;
    configuration_[5] = kLmsMode15Bits;
    configuration_[6] = kLmsUnitMm;
    enter(Phase::Installation, now_);
    return;
  }
  report(true, "measuring mode " + std::to_string(configuration_[5]) + ", unit " + std::to_string(configuration_[6]) +
                   " cannot be decoded: set lms291.configure, or the mode to 0...6 or 15");
  request_.stop();
  enter(Phase::Settle, now_);  // requested again, since the user may have changed it
}

void LmsDriver::takeRewritten(ByteView payload) {
  if (payload[1] != 1) report(true, "configuration rejected");
  enter(Phase::Configuration, now_);
}

}  // namespace segway_drivers
