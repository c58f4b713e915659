// SPDX-License-Identifier: BSD-3-Clause
#include "file/writer_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

namespace {

std::string makeLockPath(const std::string& path) { return path + "-lock"; }

/// Returns whether the file at the path is the one that was opened. A holder removes the file before it unlocks.
bool isStillThere(const std::string& path, int descriptor) {
  struct stat opened {
  }, there{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &there) == 0 && opened.st_dev == there.st_dev &&
         opened.st_ino == there.st_ino;
}

}  // namespace

WriterLock::WriterLock(const std::string& path) : lock_path_(makeLockPath(path)) {
  while (true) {
    descriptor_ = ::open(lock_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw UserError(path, std::string("cannot be written: ") + std::strerror(errno),
                      "a file and a folder that can be written");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw UserError(path, "is being written by another program", "one writer at a time");
    }
    if (isStillThere(lock_path_, descriptor_)) return;
    ::close(descriptor_);
  }
}

WriterLock::~WriterLock() {
  ::unlink(lock_path_.c_str());
  ::close(descriptor_);
}

bool WriterLock::isHeld(const std::string& path) {
  const int descriptor = ::open(makeLockPath(path).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  ::close(descriptor);
  return held;
}

}  // namespace urban_nav_store
