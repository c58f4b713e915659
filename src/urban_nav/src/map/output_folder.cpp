// SPDX-License-Identifier: BSD-3-Clause
#include "map/output_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

OutputFolder::OutputFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_))
    throw UserError(path_, "cannot be made: " + (error ? error.message() : "not a folder"), "a folder to write into");
}

std::string OutputFolder::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

std::vector<std::string> OutputFolder::list() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
    if (entry.is_regular_file(error)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void OutputFolder::write(const std::string& name, const std::string& content) const {
  urban_nav_core::writeAtomically(file(name), content);
}

void OutputFolder::remove(const std::string& name) const {
  std::error_code error;
  fs::remove(file(name), error);
}

}  // namespace urban_nav
