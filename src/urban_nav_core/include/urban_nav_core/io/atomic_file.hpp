// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// Temporary path next to the final one, for writers of other libraries (bags, images). commit() flushes the file to
/// disk and renames it; without commit(), after an exception for instance, the destructor removes it, so that no
/// partial file has the final name. Symbolic links are followed. Throws UserError for a device or a pipe.
class PartialFile {
 public:
  explicit PartialFile(const std::string& final_path);
  PartialFile(const std::string& final_path, const std::string& suffix);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Returns `final_path` with ".part" before its extension, for writers that depend on the extension; or with the
  /// suffix after it, so that a file left by a killed process is not mistaken for a complete one.
  const std::string& path() const { return path_; }
  /// Renames the file, which the writer has closed. Throws UserError naming the final path if it cannot be flushed or
  /// renamed.
  void commit();

 private:
  std::string final_path_, path_;
  bool committed_ = false;
};

/// File that is written completely or not at all; a device or a pipe (/dev/stdout) is written directly. Buffered; not
/// thread-safe. Throws UserError naming the path and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);
  void commit();

 private:
  void flushBuffer();

  std::optional<PartialFile> partial_;
  std::string name_, buffer_;
  int descriptor_ = -1;
};

void writeAtomically(const std::string& path, std::string_view content);

}  // namespace urban_nav_core
