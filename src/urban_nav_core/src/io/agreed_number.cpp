// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/agreed_number.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

namespace {

/// Writes the text to a new file beside `path`. Returns its name; empty, with errno set, on failure.
std::string writeProposal(const std::string& path, const std::string& text) {
  std::string name = path + ".XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) return "";
  const bool is_whole = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int error = errno;
  ::close(descriptor);
  if (is_whole) return name;
  ::unlink(name.c_str());
  errno = error;
  return "";
}

std::int64_t readNumber(const std::string& path) {
  const auto agreed = parseInteger(readTextFile(path));
  if (!agreed) throw UserError(path, "holds no number", "a name not used before");
  return *agreed;
}

}  // namespace

std::int64_t agreeOnNumber(const std::string& path, std::int64_t proposal) {
  std::error_code ignored;  // a folder that cannot be created causes an error of the file
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  const std::string file = writeProposal(path, std::to_string(proposal));
  // Linking to an existing name fails, so exactly one complete proposal succeeds.
  const int error = !file.empty() && ::link(file.c_str(), path.c_str()) == 0 ? 0 : errno;
  if (!file.empty()) ::unlink(file.c_str());
  if (error != 0 && error != EEXIST) throw UserError(path, std::strerror(error), "a folder that can be written");
  return readNumber(path);
}

std::optional<std::int64_t> findAgreedNumber(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  return readNumber(path);
}

}  // namespace urban_nav_core
