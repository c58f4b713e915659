// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/transport/session_begin.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

using urban_nav_core::UserError;

TimeNs agreeOnBegin(const std::string& path, TimeNs in) {
  std::error_code ignored;  // a folder that cannot be made shows in the file
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  const std::string proposal = path + "." + std::to_string(::getpid());
  urban_nav_core::writeAtomically(proposal, std::to_string(steadyTime() + in));
  // A link to a name that exists fails, so that one proposal wins and is there as a whole.
  const int error = ::link(proposal.c_str(), path.c_str()) == 0 ? 0 : errno;
  ::unlink(proposal.c_str());
  if (error != 0 && error != EEXIST) throw UserError(path, std::strerror(error), "a folder that can be written");
  const auto begin = urban_nav_core::parseInteger(urban_nav_core::readTextFile(path));
  if (!begin) throw UserError(path, "holds no time", "a name that is new for each launch");
  return *begin;
}

}  // namespace segway_drivers
