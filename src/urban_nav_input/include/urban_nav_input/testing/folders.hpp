// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace urban_nav_input::testing {

/// A temporary folder for one test, removed with this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string readFile(const std::string& path);
void writeFile(const std::string& path, const std::string& content);

/// Layout of a KITTI folder.
struct KittiStyle {
  std::string left = "image_0", right = "image_1";
  int digits = 6;
  bool times = true, truth = true;
  int frames = 16;
};
/// Writes a rendered room, 240x180 px at 20 Hz, as a KITTI folder.
void makeKittiFolder(const std::string& path, const KittiStyle& style = {});

}  // namespace urban_nav_input::testing
