// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace urban_nav_core {

/// A mistake that its user can mend: the one exception of the project. Thrown where the mistake is found, caught
/// at the edge (the command, the nodelet) and printed as `where: found: allowed ...`, for example
/// `config.yaml:12: swf_vo.window = 0: allowed 1...100000 (frames)`; empty parts are left out.
/// Faults of the data are never thrown: they are a Status in the output of a stage.
class UserError : public std::runtime_error {
 public:
  struct Parts {
    std::string where;    ///< file, or file:line, or the option; empty if there is none
    std::string found;    ///< key and value, or what is wrong
    std::string allowed;  ///< what would be right, as it reads behind the word "allowed"; empty if it is obvious
  };

  explicit UserError(Parts parts);
  UserError(std::string where, std::string found, std::string allowed);

  const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
};

/// The data did not allow what was asked (exit status 1 of the command), as opposed to a mistake in the call (2).
class DataError : public UserError {
 public:
  using UserError::UserError;
};

/// `path:line` for Parts::where; lines count from 1, 0 gives the path alone.
std::string atLine(const std::string& path, int line);

}  // namespace urban_nav_core
