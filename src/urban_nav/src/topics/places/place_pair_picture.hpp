// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "base/page.hpp"

namespace urban_nav {

/// Returns two thumbnails (JPEG), the earlier place above the query; nullopt if one of them cannot be decoded.
std::optional<PagePicture> placePairPicture(const std::string& earlier, const std::string& query,
                                            const std::string& caption);

}  // namespace urban_nav
