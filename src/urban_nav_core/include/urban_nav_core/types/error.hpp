// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace urban_nav_core {

/// Base class of all exceptions of the project; only the two derived classes are thrown.
/// The command and the nodelets print `where: found: expected ...`, for example
/// `poses.tum:2: 7 columns: expected 8: stamp x y z qx qy qz qw`; empty parts are omitted.
/// Faults of single measurements are not thrown: they are a Status in the output of a stage.
class Error : public std::runtime_error {
 public:
  struct Parts {
    std::string where;    ///< file, file:line or option; may be empty
    std::string found;    ///< key and value, or what is wrong
    std::string allowed;  ///< what would be valid, printed after "expected"; printed unchanged if it begins with
                          ///< "allowed ", as ranges and values of parameters do; may be empty
  };

  const Parts& parts() const { return parts_; }

 protected:
  explicit Error(Parts parts);
  Error(std::string where, std::string found, std::string allowed);

 private:
  Parts parts_;
};

/// An error that the user can fix: a bad option, parameter or file. Exit status 2 of the command.
class UserError final : public Error {
 public:
  explicit UserError(Parts parts);
  UserError(std::string where, std::string found, std::string allowed);
};

/// The call is valid, but the data do not allow it: a damaged store, an empty recording, a full disk. Exit status 1 of
/// the command.
class DataError final : public Error {
 public:
  explicit DataError(Parts parts);
  DataError(std::string where, std::string found, std::string allowed);
};

/// Returns `path:line` for Error::Parts::where, or the path alone if `line` is 0; lines count from 1.
std::string atLine(const std::string& path, int line);

}  // namespace urban_nav_core
