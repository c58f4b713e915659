// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBuffer = 1U << 16U;

// An unwritable path is an error of the user; a full disk is not, as in stores.
[[noreturn]] void fail(const std::string& path) {
  const int error = errno;
  const std::string what = std::string("cannot be written: ") + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) throw DataError(path, what, "");
  throw UserError(path, what, "");
}

// Returns whether the path is a device or a pipe (/dev/stdout, for instance), which a rename would replace by a file.
bool isStream(const std::string& path) {
  std::error_code ignored;
  return fs::is_other(fs::status(path, ignored));
}

// Returns the target of a symbolic link, since a rename would replace the link itself.
std::string linkTarget(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target.string();
}

std::string beside(const std::string& final_path) {
  const fs::path path(final_path);
  return (path.parent_path() / (path.stem().string() + ".part" + path.extension().string())).string();
}

// A rename is durable only after its folder is flushed. Some file systems do not support that; the file's content is
// safe then.
void flushFolder(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

PartialFile::PartialFile(const std::string& final_path) : PartialFile(final_path, "") {}

PartialFile::PartialFile(const std::string& final_path, const std::string& suffix)
    : final_path_(linkTarget(final_path)), path_(suffix.empty() ? beside(final_path_) : final_path_ + suffix) {
  if (isStream(final_path)) throw UserError(final_path, "is a device or a pipe", "a file");
}

PartialFile::~PartialFile() {
  if (!committed_) ::unlink(path_.c_str());
}

void PartialFile::commit() {
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(final_path_);
  const bool flushed = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!flushed || std::rename(path_.c_str(), final_path_.c_str()) != 0) fail(final_path_);
  committed_ = true;
  flushFolder(final_path_);
}

AtomicFile::AtomicFile(std::string path) : name_(std::move(path)) {
  if (!isStream(name_)) partial_.emplace(name_);
  const std::string& target = partial_ ? partial_->path() : name_;
  descriptor_ = ::open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(name_);
  buffer_.reserve(kBuffer);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kBuffer) flushBuffer();
}

void AtomicFile::flushBuffer() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(name_);
    done += static_cast<std::size_t>(written);
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  flushBuffer();
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) fail(name_);
  if (partial_) partial_->commit();
}

void writeAtomically(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace urban_nav_core
