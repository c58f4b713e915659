// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "view/http_server.hpp"

namespace urban_nav {

/// Admits holders of a token that is drawn anew at each start, through a page of this server alone. Programs of
/// other users of the machine lack the token; pages of other servers have another origin, and a name that was made to
/// lead to this address another host. Thread-safe.
class Gate {
 public:
  /// `address`: numeric, as in the address that is printed.
  Gate(const std::string& address, int port);

  const std::string& token() const { return token_; }
  /// Returns the address of the page.
  std::string pageAddress() const { return "http://" + hosts_.front() + "/?token=" + token_; }
  /// Returns null for a request that may go on, else 403 and nothing more; with the token, the status of what else is
  /// wrong with it.
  std::unique_ptr<HttpAnswer> admit(const HttpRequest& request) const;

 private:
  bool isTrusted(const HttpRequest& request) const;

  std::vector<std::string> hosts_;  // names of the server
  std::string token_;
};

/// Returns a text of 32 characters of [A-Za-z0-9_-] from the system's source of random numbers.
std::string drawToken();

/// Returns whether two texts are equal, in a time that depends on their lengths alone.
bool areEqualInConstantTime(const std::string& one, const std::string& other);

}  // namespace urban_nav
