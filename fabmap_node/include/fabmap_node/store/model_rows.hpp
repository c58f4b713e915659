// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/tables/stored_model.hpp"

namespace fabmap_node {

/// Returns the row that states with which model the places of a session were described. A model that is part of the
/// program (suppliedModel()) is stored by its hash alone; the bytes of any other one are in the row.
urban_nav_store::StoredModel toStoredModel(const urban_nav_store::SessionId& session, const std::string& hash,
                                           const std::string& bytes);
/// Returns the bytes of the model of a row. `where`: name of the store. Throws DataError if the row holds only the hash
/// of a model that this program does not have.
std::string modelBytes(const urban_nav_store::StoredModel& row, const std::string& where);

}  // namespace fabmap_node
