// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav {

/// A folder for temporary files, removed with this object.
class ScratchFolder {
 public:
  /// Throws UserError if none can be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace urban_nav
