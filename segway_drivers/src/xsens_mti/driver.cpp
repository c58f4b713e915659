// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/xsens_mti/driver.hpp"

#include <array>

namespace segway_drivers {

namespace {

constexpr std::array<int, 4> kMtiRates = {115200, 460800, 230400, 57600};
constexpr TimeNs kMtiFindTimeout = 100'000'000, kMtiTimeout = 500'000'000, kMtiSilence = 200'000'000;  // ns
constexpr int kMtiFindTries = 20, kMtiOtherTries = 4, kMtiSoftRestarts = 3, kMtiSamplesAsItIs = 100;
constexpr std::uint8_t kMtiAnswerTo = 1;  // added to the identifier of a request
constexpr std::uint8_t kMtiNotImplemented = 0x04;

/// Requests counter, fine time, quaternion, acceleration, rate and field at `rate`, Hz.
Bytes mtiOutputConfiguration(int rate) {
  Bytes data;
  for (const std::uint16_t item : std::array<std::uint16_t, 2>{0x1020, 0x1060}) {
    appendBig(data, item);
    appendBig(data, 0xFFFF);
  }
  for (const std::uint16_t item : std::array<std::uint16_t, 4>{0x2010, 0x4020, 0x8020, 0xC020}) {
    appendBig(data, item);
    appendBig(data, static_cast<std::uint16_t>(rate));
  }
  return data;
}

}  // namespace

MtiDriver::MtiDriver(const Options& options) : options_(options), stream_(options.stream) {
  stream_.on_sample = [this](const MtiStampedSample& sample) { takeSample(sample); };
  stream_.on_reply = [this](const MtiMessage& message) { takeReply(message); };
  mode_ = options.stream.mode;
  settings_ = options.stream.settings;
}

void MtiDriver::begin(TimeNs now) {
  now_ = last_sample_ = now;
  soft_restarts_ = 0;
  find(known_rate_.value_or(0));
}

/// Tries the last rate at which the device answered for 2 s, since it may be booting, then the others for a shorter
/// time.
void MtiDriver::find(std::size_t rate) {
  rate_ = rate;
  ignored_ = 0;
  written_period_ = written_mode_ = {};
  written_settings_ = {};
  setState(DriverState::Identifying);
  setBaud(kMtiRates[rate_]);
  stream_.setBaud(kMtiRates[rate_]);
  stream_.clear();
  phase_ = Phase::Find;
  request_.start(mtiGoToConfigCommand(), kMtiFindTimeout,
                 known_rate_ && *known_rate_ != rate ? kMtiOtherTries : kMtiFindTries);
}

std::uint16_t MtiDriver::periodCounts() const { return static_cast<std::uint16_t>(115200 / options_.rate); }

void MtiDriver::enter(Phase phase) {
  phase_ = phase;
  request_.stop();
  switch (phase) {
    case Phase::Find: find(rate_); break;
    case Phase::DeviceId: request_.start(mtiDeviceIdCommand(), kMtiTimeout); break;
    case Phase::Product: request_.start(makeMtiMessage(MtiMid::ProductCode), kMtiTimeout); break;
    case Phase::Firmware: request_.start(makeMtiMessage(MtiMid::FirmwareRevision), kMtiTimeout); break;
    case Phase::Kind: request_.start(makeMtiMessage(MtiMid::OutputConfiguration), kMtiTimeout); break;
    case Phase::ReadPeriod: request_.start(makeMtiMessage(MtiMid::Period), kMtiTimeout); break;
    case Phase::WritePeriod: request_.start(mtiPeriodCommand(periodCounts()), kMtiTimeout); break;
    case Phase::ReadMode: request_.start(makeMtiMessage(MtiMid::OutputMode), kMtiTimeout); break;
    case Phase::WriteMode:
      request_.start(mtiOutputModeCommand(static_cast<std::uint16_t>(options_.stream.mode)), kMtiTimeout);
      break;
    case Phase::ReadSettings: request_.start(makeMtiMessage(MtiMid::OutputSettings), kMtiTimeout); break;
    case Phase::WriteSettings: request_.start(mtiOutputSettingsCommand(options_.stream.settings), kMtiTimeout); break;
    case Phase::WriteOutput:
      request_.start(makeMtiMessage(MtiMid::OutputConfiguration, mtiOutputConfiguration(options_.rate)), kMtiTimeout);
      break;
    case Phase::Start: request_.start(mtiGoToMeasurementCommand(), kMtiTimeout); break;
    case Phase::Stream:
      last_sample_ = now_;
      setState(DriverState::Streaming);
      break;
  }
}

void MtiDriver::tick(TimeNs now) {
  now_ = now;
  stream_.expire(now);
  switch (request_.due(now)) {
    case PendingRequest::Due::Send: write(request_.bytes()); break;
    case PendingRequest::Due::Failed: fail(); break;
    case PendingRequest::Due::Nothing: break;
  }
  if (phase_ == Phase::Stream) watch(now);
}

void MtiDriver::fail() {
  countTimeout();
  if (phase_ == Phase::Product || phase_ == Phase::Firmware) {  // not supported by every unit
    enter(phase_ == Phase::Product ? Phase::Firmware : Phase::Kind);
  } else if (phase_ == Phase::Find && ignored_ >= kMtiSamplesAsItIs) {
    report(true,
           "already streaming and ignores requests: used without configuration; switch it off and on to configure it");
    enter(Phase::Stream);
  } else if (phase_ == Phase::Find && (rate_ + 1) % kMtiRates.size() == known_rate_.value_or(0)) {
    write(mtiResetCommand());
    reopen();
  } else {
    find(phase_ == Phase::Find ? (rate_ + 1) % kMtiRates.size() : rate_);
  }
}

void MtiDriver::watch(TimeNs now) {
  if (now - last_sample_ < kMtiSilence) return;
  if (soft_restarts_++ < kMtiSoftRestarts) {
    setState(DriverState::Stalled, "no message for 0.2 s");
    last_sample_ = now;
    write(mtiGoToMeasurementCommand());
  } else {
    soft_restarts_ = 0;
    find(known_rate_.value_or(0));
  }
}

void MtiDriver::takeSample(const MtiStampedSample& sample) {
  if (phase_ == Phase::Find) ++ignored_;
  if (phase_ == Phase::Start) enter(Phase::Stream);
  if (phase_ != Phase::Stream) return;
  last_sample_ = now_;
  soft_restarts_ = 0;
  setState(DriverState::Streaming);
  if (on_sample) on_sample(sample);
}

void MtiDriver::takeReply(const MtiMessage& message) {
  if (message.mid == static_cast<std::uint8_t>(MtiMid::WakeUp)) {
    write(makeMtiMessage(MtiMid::WakeUpAck));
    report(true, "restarted");
    find(rate_);
  } else if (message.mid == static_cast<std::uint8_t>(MtiMid::Error)) {
    takeError(message);
  } else if (request_.isActive() && message.mid == request_.bytes()[2] + kMtiAnswerTo) {
    takeAnswer(message);
  } else if (message.mid != 0x11 && message.mid != 0x0D) {  // answers to a soft restart; sent unrequested after one
    countUnexpected();
  }
}

void MtiDriver::takeAnswer(const MtiMessage& message) {
  const ByteView data = message.data;
  switch (phase_) {
    case Phase::Find:
      setState(DriverState::Configuring);
      enter(Phase::DeviceId);
      break;
    case Phase::DeviceId:
      known_rate_ = rate_;
      setIdentity("MTi " + printHex(data));
      enter(Phase::Product);
      break;
    case Phase::Product:
      setIdentity(identity() + " " + std::string(data.begin(), data.end()));
      enter(Phase::Firmware);
      break;
    case Phase::Firmware:
      setIdentity(identity() + " firmware " + printHex(data));
      enter(Phase::Kind);
      break;
    case Phase::Kind: {
      const Bytes wish = mtiOutputConfiguration(options_.rate);
      enter(Bytes(data.begin(), data.end()) == wish ? Phase::Start : Phase::WriteOutput);
      break;
    }
    case Phase::ReadPeriod:
    case Phase::WritePeriod:
      if (data.size == 2) takePeriod(bigWord(data.data));
      else enter(Phase::ReadPeriod);
      break;
    case Phase::ReadMode:
    case Phase::WriteMode:
      if (data.size == 2) takeMode(bigWord(data.data));
      else enter(Phase::ReadMode);
      break;
    case Phase::ReadSettings:
    case Phase::WriteSettings:
      if (data.size >= 4) takeSettings(bigWord32(data.data));
      else enter(Phase::ReadSettings);
      break;
    case Phase::WriteOutput: enter(Phase::Start); break;
    case Phase::Start: enter(Phase::Stream); break;
    case Phase::Stream: break;
  }
}

void MtiDriver::takeError(const MtiMessage& message) {
  const std::uint8_t code = message.data[0];
  if (phase_ == Phase::Kind && code == kMtiNotImplemented) {  // an older unit: MTData
    enter(Phase::ReadPeriod);
  } else if (phase_ == Phase::Product || phase_ == Phase::Firmware) {
    enter(phase_ == Phase::Product ? Phase::Firmware : Phase::Kind);
  } else {
    report(true, "device reports error " + printHex(message.data));
  }
}

void MtiDriver::takePeriod(std::uint16_t counts) {
  if (counts != periodCounts() && !written_period_) {
    written_period_ = counts;
    enter(Phase::WritePeriod);
    return;
  }
  if (counts == 0) {
    enter(Phase::ReadPeriod);
    return;
  }
  stream_.setPeriod(counts / 115200.0);
  enter(Phase::ReadMode);
}

void MtiDriver::takeMode(std::uint16_t mode) {
  if (mode != options_.stream.mode && !written_mode_) {
    written_mode_ = mode;
    enter(Phase::WriteMode);
    return;
  }
  mode_ = mode;
  enter(Phase::ReadSettings);
}

void MtiDriver::takeSettings(std::uint32_t settings) {
  if (settings != options_.stream.settings && !written_settings_) {
    written_settings_ = settings;
    enter(Phase::WriteSettings);
    return;
  }
  settings_ = settings;
  stream_.setDataFormat(mode_, settings_);
  if (!mtiDataLength(mode_, settings_)) report(true, "output mode " + std::to_string(mode_) + " cannot be decoded");
  enter(Phase::Start);
}

}  // namespace segway_drivers
