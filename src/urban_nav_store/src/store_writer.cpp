// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/store_writer.hpp"

#include "file/header.hpp"
#include "file/writer_lock.hpp"

namespace urban_nav_store {

bool isBeingWritten(const std::string& path) { return WriterLock::isHeld(resolved(path)); }

}  // namespace urban_nav_store
