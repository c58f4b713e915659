// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav {

/// Opens an address in the browser of the user, through a file readable only by this user, since command lines are
/// visible to all users. The file is removed with this object. No effect without an address, a display or xdg-open.
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
