// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/gpsd.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace segway_drivers {

namespace {

constexpr std::string_view kGpsdBegin = "{\"class\":";
constexpr double kGpsdLevel = 1.96;     // gpsd states errors at the 95 % level
constexpr double kGpsdCircle = 2.4477;  // 95 % radius of a circular normal distribution, in sigmas

std::optional<double> gpsdNumber(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  const double value = found->get<double>();
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::string gpsdText(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<double> gpsdSigma(const nlohmann::json& object, const char* key, double level = kGpsdLevel) {
  const auto value = gpsdNumber(object, key);
  return value && *value > 0.0 ? std::optional<double>(*value / level) : std::nullopt;
}

/// Sets the status of a TPV: 2 differential, 3 and 4 fixed and floating ambiguities.
void setGpsdStatus(std::optional<double> status, GpsFix& fix) {
  if (!status) return;
  fix.differential = *status >= 2.0 && *status <= 4.0;
  if (*status == 3.0) fix.carrier = GpsFix::Carrier::Fixed;
  if (*status == 4.0) fix.carrier = GpsFix::Carrier::Float;
}

/// Sets errors: epx and epy by axis, or eph, the radius of a circle, if they are missing; epv.
void setGpsdErrors(const nlohmann::json& object, GpsFix& fix) {
  const auto circle = gpsdSigma(object, "eph", kGpsdCircle);
  fix.sigma_e = gpsdSigma(object, "epx");
  fix.sigma_n = gpsdSigma(object, "epy");
  if (!fix.sigma_e) fix.sigma_e = circle ? circle : fix.sigma_n;
  if (!fix.sigma_n) fix.sigma_n = circle ? circle : fix.sigma_e;
  fix.sigma_u = gpsdSigma(object, "epv");
}

/// Returns the time if it is valid as a cell of a table.
std::string gpsdTime(const nlohmann::json& object) {
  const std::string text = gpsdText(object, "time");
  const bool plain =
      text.size() < 40 && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || c == '-' || c == ':' || c == '.' || c == 'T' || c == 'Z' || c == '+';
      });
  return plain ? text : std::string();
}

GpsFix gpsdFix(const nlohmann::json& object) {
  GpsFix fix;
  fix.source = "gpsd";
  fix.utc = gpsdTime(object);
  const auto mode = gpsdNumber(object, "mode"), status = gpsdNumber(object, "status");
  if (mode && *mode >= 2.0) fix.mode = *mode >= 3.0 ? GpsFix::Mode::Fix3D : GpsFix::Mode::Fix2D;
  setGpsdStatus(status, fix);
  const auto latitude = gpsdNumber(object, "lat"), longitude = gpsdNumber(object, "lon");
  const bool placed = latitude && longitude && std::abs(*latitude) <= 90.0 && std::abs(*longitude) <= 180.0;
  if (!placed) fix.mode = GpsFix::Mode::None;
  if (fix.mode == GpsFix::Mode::None) return fix;
  fix.latitude = latitude;
  fix.longitude = longitude;
  if (fix.mode == GpsFix::Mode::Fix3D) fix.height = gpsdNumber(object, "altHAE");
  setGpsdErrors(object, fix);
  fix.track = gpsdNumber(object, "track");
  fix.speed = gpsdNumber(object, "speed");
  fix.climb = gpsdNumber(object, "climb");
  return fix;
}

std::optional<int> gpsdSatellites(const nlohmann::json& object) {
  if (const auto used = gpsdNumber(object, "uSat"); used && *used >= 0.0 && *used < 1000.0)
    return static_cast<int>(*used);
  const auto list = object.find("satellites");
  if (list == object.end() || !list->is_array()) return std::nullopt;
  return static_cast<int>(std::count_if(list->begin(), list->end(), [](const nlohmann::json& each) {
    return each.is_object() && each.contains("used") && each["used"].is_boolean() && each["used"].get<bool>();
  }));
}

}  // namespace

Bytes makeGpsdWatch() {
  const std::string text = "?WATCH={\"enable\":true,\"json\":true};\n";
  return Bytes(text.begin(), text.end());
}

FrameProbe probeGpsdLine(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  for (std::size_t i = 0; i < bytes.size && i < kGpsdBegin.size(); ++i)
    if (bytes[i] != static_cast<std::uint8_t>(kGpsdBegin[i])) return {Kind::NoFrame, 0};
  const auto* end = std::find(bytes.begin(), bytes.end(), std::uint8_t{'\n'});
  if (end == bytes.end()) return {bytes.size < kGpsdLongestLine ? Kind::Incomplete : Kind::NoFrame, 0};
  const auto size = static_cast<std::size_t>(end - bytes.begin()) + 1;
  return {size <= kGpsdLongestLine ? Kind::Frame : Kind::NoFrame, size};
}

std::optional<GpsdReport> parseGpsdLine(std::string_view line) {
  const nlohmann::json object = nlohmann::json::parse(line.begin(), line.end(), nullptr, false);
  if (!object.is_object()) return std::nullopt;
  GpsdReport report;
  report.kind = gpsdText(object, "class");
  if (report.kind.empty()) return std::nullopt;
  if (report.kind == "TPV") report.fix = gpsdFix(object);
  if (report.kind == "SKY") report.satellites = gpsdSatellites(object);
  if (report.kind == "VERSION") report.version = gpsdText(object, "release");
  return report;
}

}  // namespace segway_drivers
