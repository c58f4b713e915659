// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/table_store.hpp"

#include "store_implementation.hpp"

namespace urban_nav_store {

AnyTableStore::AnyTableStore(Store& store, const Table& table)
    : access_(&store.implementation().tables), table_(&table) {}

void AnyTableStore::putRow(const AnyRow& row) { access_->put(*table_, row); }

bool AnyTableStore::getRow(const AnyRow& row) const { return access_->find(*table_, row); }

void AnyTableStore::removeRow(const AnyRow& key) { access_->remove(*table_, key, table_->keys); }

void AnyTableStore::forEachRow(const SessionId& session, const AnyRow& row, const std::function<void()>& visit) const {
  access_->forEach(*table_, session, row, visit);
}

void AnyTableStore::forEachRowBetween(const AnyRow& row, std::int64_t from, std::int64_t to,
                                      const std::function<void()>& visit) const {
  access_->forEachBetween(*table_, row, from, to, visit);
}

std::vector<std::int64_t> AnyTableStore::lastKeysBetween(const AnyRow& row, std::int64_t from, std::int64_t to) const {
  return access_->lastKeys(*table_, row, from, to);
}

}  // namespace urban_nav_store
