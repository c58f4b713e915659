// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "schema/schema.hpp"
#include "stage_tables.hpp"  // generated of include/urban_nav_store/tables/
#include "tables/graph_tables.hpp"
#include "tables/measurement_tables.hpp"
#include "tables/session_tables.hpp"

namespace urban_nav_store::schema {

namespace {

Tables declaredTables() {
  Tables all = {&declaredTable<SessionRow>(),   &declaredTable<AnchorRow>(),    &declaredTable<ParameterRow>(),
                &declaredTable<PropertyRow>(),  &declaredTable<ExtrinsicRow>(), &declaredTable<NodeRow>(),
                &declaredTable<RelaxedRow>(),   &declaredTable<EdgeRow>(),      &declaredTable<EvidenceRow>(),
                &declaredTable<ScanBlockRow>(), &declaredTable<KeyframeRow>(),  &declaredTable<InputBlockRow>(),
                &declaredTable<StatePartRow>()};
  Tables later = stageTables();
  std::stable_sort(later.begin(), later.end(), [](const Table* a, const Table* b) { return a->since < b->since; });
  all.insert(all.end(), later.begin(), later.end());
  return all;
}

}  // namespace

const Tables& tables() {
  static const Tables all = declaredTables();
  return all;
}

}  // namespace urban_nav_store::schema
