// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/defect.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

using urban_nav_core::UserError;

namespace {

constexpr const char* kAny = "all";

constexpr std::array<std::pair<Defect, const char*>, 23> kNames = {{{Defect::Noise, "noise"},
                                                                    {Defect::Bias, "bias"},
                                                                    {Defect::Blur, "blur"},
                                                                    {Defect::Vignetting, "vignetting"},
                                                                    {Defect::Exposure, "exposure"},
                                                                    {Defect::Lens, "lens"},
                                                                    {Defect::Edges, "edges"},
                                                                    {Defect::Losses, "losses"},
                                                                    {Defect::Steps, "steps"},
                                                                    {Defect::Offset, "offset"},
                                                                    {Defect::Scale, "scale"},
                                                                    {Defect::Delay, "delay"},
                                                                    {Defect::Axes, "axes"},
                                                                    {Defect::Degrees, "degrees"},
                                                                    {Defect::Ned, "ned"},
                                                                    {Defect::Gravity, "gravity"},
                                                                    {Defect::Tyres, "tyres"},
                                                                    {Defect::Slip, "slip"},
                                                                    {Defect::Multipath, "multipath"},
                                                                    {Defect::Gaps, "gaps"},
                                                                    {Defect::Times, "times"},
                                                                    {Defect::Jitter, "jitter"},
                                                                    {Defect::Clock, "clock"}}};

std::string defectName(Defect defect) {
  return std::find_if(kNames.begin(), kNames.end(), [defect](const auto& each) { return each.first == defect; })
      ->second;
}

constexpr std::array<Defect, 10> kUnusual = {Defect::Lens,  Defect::Offset,  Defect::Scale, Defect::Delay,
                                             Defect::Axes,  Defect::Degrees, Defect::Ned,   Defect::Gravity,
                                             Defect::Times, Defect::Clock};

bool isUsual(Defect defect) { return std::find(kUnusual.begin(), kUnusual.end(), defect) == kUnusual.end(); }

std::vector<Defect> availableDefects(Sensor sensor) {
  std::vector<Defect> defects;
  switch (sensor) {
    case Sensor::Stereo:
      defects = {Defect::Noise, Defect::Blur, Defect::Vignetting, Defect::Exposure, Defect::Lens};
      break;
    case Sensor::Ladybug: defects = {Defect::Noise, Defect::Blur, Defect::Vignetting, Defect::Exposure}; break;
    case Sensor::Lasers:
      defects = {Defect::Noise, Defect::Bias, Defect::Edges, Defect::Losses, Defect::Steps, Defect::Offset};
      break;
    case Sensor::Imu:
      defects = {Defect::Noise, Defect::Bias,    Defect::Offset, Defect::Scale,  Defect::Delay,
                 Defect::Axes,  Defect::Degrees, Defect::Ned,    Defect::Gravity};
      break;
    case Sensor::Wheels: defects = {Defect::Tyres, Defect::Slip, Defect::Steps, Defect::Scale, Defect::Delay}; break;
    case Sensor::Gps: defects = {Defect::Noise, Defect::Bias, Defect::Multipath, Defect::Gaps}; break;
    case Sensor::Lidar3d:
      defects = {Defect::Noise, Defect::Bias, Defect::Edges, Defect::Losses, Defect::Steps, Defect::Times};
      break;
  }
  defects.insert(defects.end(), {Defect::Jitter, Defect::Clock});
  return defects;
}

std::string listDefects(Sensor sensor) {
  std::string list;
  for (const Defect defect : availableDefects(sensor)) list += (list.empty() ? "" : ", ") + defectName(defect);
  return list;
}

/// Returns the sensors and defects of a word of the command line, at least one.
std::vector<std::pair<Sensor, Defect>> parse(const std::string& word, const std::string& where) {
  const std::size_t colon = word.find(':');
  if (colon == std::string::npos) throw UserError(where, "\"" + word + "\"", "SENSOR:DEFECT, as in imu:noise");
  const std::string of = word.substr(0, colon), name = word.substr(colon + 1);
  const std::vector<Sensor> sensors = of == kAny ? std::vector<Sensor>(kAllSensors.begin(), kAllSensors.end())
                                                 : std::vector<Sensor>{parseSensor(of, where)};
  std::vector<std::pair<Sensor, Defect>> meant;
  for (const Sensor sensor : sensors)
    for (const Defect defect : availableDefects(sensor))
      if (name == kAny ? isUsual(defect) : name == defectName(defect)) meant.emplace_back(sensor, defect);
  if (!meant.empty()) return meant;
  std::string list;
  for (const auto& each : kNames) list += (list.empty() ? "" : ", ") + std::string(each.second);
  throw UserError(where, "defect \"" + word + "\"", of == kAny ? list : listDefects(sensors.front()));
}

}  // namespace

Defects::Defects() {
  for (const Sensor sensor : kAllSensors)
    for (const Defect defect : availableDefects(sensor))
      if (isUsual(defect)) on_.emplace(sensor, defect);
}

void Defects::switchOn(const std::string& word, const std::string& where) {
  for (const auto& each : parse(word, where)) on_.insert(each);
}

void Defects::switchOff(const std::string& word, const std::string& where) {
  for (const auto& each : parse(word, where)) on_.erase(each);
}

std::string defectHelp() {
  std::string unusual;
  for (const Defect defect : kUnusual) unusual += (unusual.empty() ? "" : ", ") + defectName(defect);
  std::string text = "Defects of the sensors (only with --with: " + unusual + "):\n";
  for (const Sensor sensor : kAllSensors) {
    std::string name = toString(sensor);
    name.resize(9, ' ');
    text += "  " + name + listDefects(sensor) + "\n";
  }
  return text;
}

}  // namespace urban_nav_sim
