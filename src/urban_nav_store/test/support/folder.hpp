// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store::testing {

/// Temporary folder for one test, removed by the destructor.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Returns the number of entries.
  std::size_t files() const;

 private:
  std::filesystem::path path_;
};

std::string readFile(const std::string& path);
void writeFile(const std::string& path, const std::string& content);

/// Returns the text of the UserError that a call throws, or "".
template <typename Call>
std::string catchError(const Call& call) {
  try {
    call();
  } catch (const urban_nav_core::Error& error) {
    return error.what();
  }
  return "";
}

/// Expects a UserError that names the file and contains these words.
template <typename Call>
void expectError(const Call& call, const std::string& file, const std::string& words) {
  const std::string text = catchError(call);
  EXPECT_EQ(text.rfind(file, 0), 0U) << text;
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

}  // namespace urban_nav_store::testing
