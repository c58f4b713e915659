// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav {

/// Output folder of a run. Files appear atomically: each is written under a temporary name, flushed and renamed.
class OutputFolder {
 public:
  /// Creates the folder if it does not exist. Throws UserError if that fails.
  explicit OutputFolder(std::string path);

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const;
  /// Returns the names of its files, sorted.
  std::vector<std::string> list() const;
  void write(const std::string& name, const std::string& content) const;
  /// Removes a file that this run does not write, if it exists.
  void remove(const std::string& name) const;

 private:
  std::string path_;
};

}  // namespace urban_nav
