// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav {

/// A temporary store next to the final one, and a folder for files of the stages. Both are removed unless the store is
/// published.
class Workplace {
 public:
  /// Throws UserError if the folder of `out` does not exist.
  explicit Workplace(const std::string& out);
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const std::string& store() const { return store_; }
  const std::string& folder() const { return folder_; }
  /// Copies the temporary store atomically to `out`. Requires that it is closed.
  void publish();

 private:
  void clear();

  const std::string out_, store_, folder_;
};

}  // namespace urban_nav
