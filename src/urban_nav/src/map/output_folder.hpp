// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav {

/// The folder a run writes into. Each file appears whole or not at all: it is written beside its place, flushed,
/// renamed.
class OutputFolder {
 public:
  /// Makes the folder if it does not exist. Throws UserError if that fails.
  explicit OutputFolder(std::string path);

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const;
  /// Returns the names of its files, sorted.
  std::vector<std::string> list() const;
  void write(const std::string& name, const std::string& content) const;
  /// Removes a file that this run does not make; does nothing if there is none.
  void remove(const std::string& name) const;

 private:
  std::string path_;
};

}  // namespace urban_nav
