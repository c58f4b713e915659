// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/page_answers.hpp"
#include "view/teach/teach_source.hpp"

namespace urban_nav {

/// Answers the requests of the page of `labels teach` admitted by the gate, as PageRoutes does for `view`. Thread-safe.
class TeachRoutes {
 public:
  /// Both must outlive this object.
  TeachRoutes(TeachSource& source, PageEvents& events) : source_(source), events_(events) {}

  HttpAnswer answer(const HttpRequest& request) const;

 private:
  HttpAnswer answerAdmitted(const HttpRequest& request) const;

  TeachSource& source_;
  PageEvents& events_;
};

/// Returns the page with embedded scripts and style.
std::string teachPage();

}  // namespace urban_nav
