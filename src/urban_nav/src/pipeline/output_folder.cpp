// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/output_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

OutputFolder::OutputFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_)) throw UserError(path_, "cannot be made: " + (error ? error.message() : "it is no folder"), "a folder to write into");
}

std::string OutputFolder::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

void OutputFolder::write(const std::string& name, const std::string& content) const { writeWhole(file(name), content); }

void OutputFolder::remove(const std::string& name) const {
  std::error_code error;
  fs::remove(file(name), error);
}

void writeWhole(const std::string& path, const std::string& content) {
  const std::string beside = path + ".part";
  const auto fail = [&](const std::string& what) -> UserError { return {path, what + ": " + std::strerror(errno), ""}; };
  const int file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) throw fail("cannot be written");
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const UserError error = fail("cannot be written");
      ::close(file);
      ::unlink(beside.c_str());
      throw error;
    }
    written += static_cast<std::size_t>(count);
  }
  ::fsync(file);
  ::close(file);
  if (::rename(beside.c_str(), path.c_str()) != 0) throw fail("cannot be renamed into place");
}

}  // namespace urban_nav
