// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// A path to write to beside the final one, for other libraries' writers (bags, pictures). commit() flushes the file to
/// disk and renames it; without commit() (an exception, say) the destructor removes it, so that no partial file ever
/// has the final name. A link stays, and what it points to is replaced. Throws UserError for a device or a pipe.
class PartialFile {
 public:
  explicit PartialFile(const std::string& final_path);
  PartialFile(const std::string& final_path, const std::string& suffix);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// `final_path` with ".part" before its extension, so that writers who look at the extension are content; or with the
  /// suffix after it, so that what a killed process leaves is not taken for a whole file.
  const std::string& path() const { return path_; }
  /// The writer has closed the file. Throws UserError naming the final path if it cannot be flushed or renamed.
  void commit();

 private:
  std::string final_path_, path_;
  bool committed_ = false;
};

/// A file that appears whole or not at all; a device or a pipe (/dev/stdout) is written as it is. Buffered; not
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
