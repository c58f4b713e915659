// SPDX-License-Identifier: BSD-3-Clause
#include "view/browser.hpp"

#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/plot.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

extern char** environ;

namespace urban_nav {

namespace fs = std::filesystem;

OpenedBrowser::OpenedBrowser(const std::string& address) {
  if (address.empty() || (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr)) return;
  std::error_code error;
  folder_ = (fs::temp_directory_path(error) / "urban_nav-view-XXXXXX").string();
  if (error || ::mkdtemp(folder_.data()) == nullptr) {  // its mode is 0700
    folder_.clear();
    return;
  }
  std::string page = folder_ + "/open.html", program = "xdg-open";
  urban_nav_core::writeAtomically(page, "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" +
                                            escapeHtml(address) + "\"><title>urban_nav</title>\n");
  char* const words[] = {program.data(), page.data(), nullptr};
  pid_t child = 0;
  posix_spawnattr_t attributes;
  sigset_t none;
  sigemptyset(&none);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  if (::posix_spawnp(&child, program.c_str(), nullptr, &attributes, words, environ) == 0)
    ::waitpid(child, nullptr, WNOHANG);
  ::posix_spawnattr_destroy(&attributes);
}

OpenedBrowser::~OpenedBrowser() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace urban_nav
