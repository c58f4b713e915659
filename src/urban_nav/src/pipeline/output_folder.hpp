// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav {

/// The folder a run writes into. Each file appears whole or not at all: written beside, flushed, renamed.
class OutputFolder {
 public:
  /// Makes the folder where it is not there. UserError where that is not possible.
  explicit OutputFolder(std::string path);

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const;
  bool has(const std::string& name) const;
  void write(const std::string& name, const std::string& content) const;
  /// A file of an earlier run that this one does not make.
  void remove(const std::string& name) const;

 private:
  std::string path_;
};

}  // namespace urban_nav
