// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/stream.hpp"

#include <cmath>

#include "segway_drivers/gps/garmin.hpp"
#include "segway_drivers/gps/gpsd.hpp"
#include "segway_drivers/gps/ubx.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kGpsSilence = 400'000'000;  // ns

FrameProbe probeGps(ByteView bytes) {
  switch (bytes[0]) {
    case '$': return probeNmeaSentence(bytes);
    case '{': return probeGpsdLine(bytes);
    case 0xB5: return probeUbxFrame(bytes);
    case 0xD3: return probeRtcmFrame(bytes);
    default: return probeGarminPacket(bytes);
  }
}

}  // namespace

GpsStream::GpsStream(const Options& options)
    : options_(options),
      frames_(kGpsdLongestLine + 1, probeGps),
      sink_([this](const StreamFrame& frame) { take(frame); }),
      nmea_(options.uere),
      nmea_sink_([this](const GpsFix& fix) { giveOut(fix); }) {}

void GpsStream::feed(ByteView chunk, const ChunkArrival& arrival) {
  last_arrival_ = arrival.time;
  frames_.feed(chunk, arrival, sink_);
}

void GpsStream::expire(TimeNs now) {
  frames_.expire(now, sink_);
  if (last_arrival_ != 0 && now - last_arrival_ >= kGpsSilence) nmea_.finish(nmea_sink_);
}

void GpsStream::finish() {
  frames_.finish(sink_);
  nmea_.finish(nmea_sink_);
}

void GpsStream::take(const StreamFrame& frame) {
  if (frame.bytes[0] == '{') {
    takeGpsd(frame);
  } else if (frame.bytes[0] == '$') {
    const NmeaSentence sentence = splitNmeaSentence(frame.bytes);
    if (on_message) on_message(std::string(sentence.kind));
    nmea_.add(sentence, frame.offset, frame.arrival, nmea_sink_);
  } else if (frame.bytes[0] == 0xD3) {
    if (on_message) on_message(rtcmName(frame.bytes));
  } else if (frame.bytes[0] == 0xB5) {
    if (on_message) on_message(ubxName(frame.bytes));
    takeBinary(frame, decodeUbxFix(frame.bytes));
  } else {
    const GarminPacket packet = splitGarminPacket(frame.bytes);
    if (on_message) on_message("garmin " + std::to_string(packet.id));
    takeBinary(frame, decodeGarminFix(packet));
  }
}

void GpsStream::takeBinary(const StreamFrame& frame, std::optional<GpsFix> fix) {
  if (!fix) return;
  fix->offset = frame.offset;
  fix->arrival = frame.arrival;
  giveOut(*fix);
}

void GpsStream::takeGpsd(const StreamFrame& frame) {
  const std::string_view line(reinterpret_cast<const char*>(frame.bytes.data), frame.bytes.size);
  std::optional<GpsdReport> report = parseGpsdLine(line);
  if (!report) {
    ++unexpected_;
    return;
  }
  if (on_message) on_message("gpsd " + report->kind);
  if (report->satellites) satellites_ = report->satellites;
  if (!report->fix) return;
  report->fix->offset = frame.offset;
  report->fix->arrival = frame.arrival;
  report->fix->satellites = satellites_;
  giveOut(*report->fix);
}

void GpsStream::giveOut(GpsFix fix) {
  if (!fix.utc.empty() && fix.utc == last_utc_) return;
  last_utc_ = fix.utc;
  std::optional<TimeNs> stamp;
  if (fix.arrival != 0) stamp = fix.arrival - static_cast<TimeNs>(std::llround(1e9 * options_.latency));
  if (on_fix) on_fix(fix, stamp);
}

DeviceCounters GpsStream::counters() const {
  DeviceCounters counters = frames_.counters();
  counters.unexpected = unexpected_;
  return counters;
}

}  // namespace segway_drivers
