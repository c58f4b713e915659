// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "view/http_server.hpp"

namespace urban_nav {

/// Admits requests with a token, drawn at each start, from pages of this server only. Programs of other users of the
/// machine do not have the token; pages of other servers have another origin, and DNS rebinding gives another host.
/// Thread-safe.
class Gate {
 public:
  /// `address`: numeric, as in the printed address.
  Gate(const std::string& address, int port);

  const std::string& token() const { return token_; }
  /// Returns the address of the page.
  std::string pageAddress() const { return "http://" + hosts_.front() + "/?token=" + token_; }
  /// Returns null for an admitted request; 403 without the token; with the token, the status of another defect.
  std::unique_ptr<HttpAnswer> admit(const HttpRequest& request) const;

 private:
  bool isTrusted(const HttpRequest& request) const;

  std::vector<std::string> hosts_;  // names of the server
  std::string token_;
};

/// Returns a text of 32 characters of [A-Za-z0-9_-] from the system's source of random numbers.
std::string drawToken();

/// Returns whether two texts are equal, in a time that depends only on their lengths.
bool areEqualInConstantTime(const std::string& one, const std::string& other);

}  // namespace urban_nav
