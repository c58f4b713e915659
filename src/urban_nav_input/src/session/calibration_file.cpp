// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/calibration_file.hpp"

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;

std::pair<urban_nav_core::CameraInfo, urban_nav_core::CameraInfo> readCalibration(const std::string& files, int width,
                                                                                  int height,
                                                                                  urban_nav_core::KittiPair pair) {
  const std::vector<std::string_view> names = urban_nav_core::splitAt(files, ',');
  if (names.size() == 2)
    return {urban_nav_core::readCameraInfo(std::string(names[0])),
            urban_nav_core::readCameraInfo(std::string(names[1]))};
  const bool yaml =
      files.size() > 4 && (files.substr(files.size() - 4) == "yaml" || files.substr(files.size() - 4) == ".yml");
  if (names.size() > 2 || yaml)
    throw UserError("--calibration", files, "a file like KITTI's calib.txt, or LEFT.yaml,RIGHT.yaml (camera_info)");
  const urban_nav_core::StereoCamera camera = urban_nav_core::readKittiCalibration(files, width, height, pair);
  return {urban_nav_core::leftInfo(camera), urban_nav_core::rightInfo(camera)};
}

}  // namespace urban_nav_input
