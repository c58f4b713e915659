// SPDX-License-Identifier: BSD-3-Clause
#include "join/workplace.hpp"

#include <filesystem>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

Workplace::Workplace(const std::string& out) : out_(out), store_(out + ".joining"), folder_(out + ".joining.files") {
  const fs::path parent = fs::absolute(out).parent_path();
  if (!fs::is_directory(parent))
    throw urban_nav_core::UserError(out, "missing folder " + parent.string(), "an existing folder");
  clear();
  fs::create_directory(folder_);
}

Workplace::~Workplace() { clear(); }

void Workplace::publish() { urban_nav_store::merge({store_}, out_); }

void Workplace::clear() {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(store_ + suffix, ignored);
  fs::remove_all(folder_, ignored);
}

}  // namespace urban_nav
