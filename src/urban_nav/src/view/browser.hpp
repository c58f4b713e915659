// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav {

/// Opens an address in the user's browser where there is a display, through a file that only this user can read: a
/// command line is visible to all users. The file vanishes with this object. Does nothing without an address, a
/// display or xdg-open.
class OpenedBrowser {
 public:
  explicit OpenedBrowser(const std::string& address);
  ~OpenedBrowser();
  OpenedBrowser(const OpenedBrowser&) = delete;
  OpenedBrowser& operator=(const OpenedBrowser&) = delete;

 private:
  std::string folder_;
};

}  // namespace urban_nav
