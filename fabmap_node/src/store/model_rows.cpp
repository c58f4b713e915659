// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/store/model_rows.hpp"

#include "fabmap_node/model/place_model.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_store::StoredModel;

StoredModel toStoredModel(const urban_nav_store::SessionId& session, const std::string& hash,
                          const std::string& bytes) {
  return {session, hash, "fabmap_node", suppliedModel(hash) ? std::string() : bytes};
}

std::string modelBytes(const StoredModel& row, const std::string& where) {
  if (!row.bytes.empty()) return row.bytes;
  const auto supplied = suppliedModel(row.hash);
  if (!supplied)
    throw urban_nav_core::DataError(where, "has places of the model " + row.hash + ", which this program does not have",
                                    "the version of the program that wrote it, or a later one");
  return std::string(*supplied);
}

}  // namespace fabmap_node
