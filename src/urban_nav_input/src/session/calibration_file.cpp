// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/calibration_file.hpp"

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/stereo_calibration.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;

std::pair<urban_nav_core::CameraInfo, urban_nav_core::CameraInfo> readCalibration(const std::string& files, int width,
                                                                                  int height,
                                                                                  urban_nav_core::KittiPair pair) {
  std::vector<std::string> names, texts;
  for (const std::string_view name : urban_nav_core::splitAt(files, ',')) names.emplace_back(name);
  if (names.size() > 2)
    throw UserError("--calibration", files + ": " + std::to_string(names.size()) + " files", "one, or LEFT,RIGHT");
  for (const std::string& name : names) texts.push_back(urban_nav_core::readTextFile(name));
  if (names.size() == 2 || urban_nav_core::calibrationKind(texts.front()) != urban_nav_core::CalibrationKind::Other)
    return urban_nav_core::parseStereoCalibration(texts, names);
  const urban_nav_core::StereoCamera camera =
      urban_nav_core::parseKittiCalibration(texts.front(), files, width, height, pair);
  return {urban_nav_core::leftInfo(camera), urban_nav_core::rightInfo(camera)};
}

void scaleBaseline(double scale, urban_nav_core::CameraInfo& left, urban_nav_core::CameraInfo& right) {
  for (urban_nav_core::CameraInfo* info : {&left, &right}) info->P(0, 3) *= scale;
}

void scaleBaseline(double scale, const std::string& where, urban_nav_core::StereoCamera& camera) {
  camera.baseline *= scale;
  if (!(camera.baseline > 0.0))
    throw UserError("input.baseline_scale", urban_nav_core::printNumber(scale),
                    "a scale above zero: the baseline of " + where + " has the right sign");
}

}  // namespace urban_nav_input
