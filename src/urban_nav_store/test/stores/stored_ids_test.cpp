// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/stored_ids.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "support/folder.hpp"
#include "tables/graph_tables.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace urban_nav_store {
namespace {

const char* const kId = "00112233445566778899";

TEST(StoredIds, AreHexadecimalDigits) {
  EXPECT_TRUE(isStoredId("0123456789abcdef"));
  EXPECT_TRUE(isStoredId(std::string(64, 'f')));
  EXPECT_TRUE(isStoredId(makeSessionId({"lisa", "monday", 1, "inputs"})));
  for (const std::string& text :
       {std::string(), std::string(15, '0'), std::string(65, '0'), std::string("../../../../etc/x"),
        std::string("0123456789ABCDEF"), std::string("0123456789abcde/"), std::string("0123456789abcde\0", 16),
        std::string("0123456789abcde\x1b", 16)})
    EXPECT_FALSE(isStoredId(text)) << text;
}

TEST(StoredIds, OfEachColumnAreCheckedWhenAStoreIsOpened) {
  const testing::Folder folder;
  const auto make = [&](const std::string& name, const std::function<void(Store&)>& add) {
    Store store(folder.file(name), Access::Write);
    store.sessions().put(Session{kId, "monday", "", "", 0, true});
    add(store);
    store.commit();
    store.close();
    return folder.file(name);
  };
  EXPECT_EQ(openForReading(make("good.db", [](Store&) {})).sessions().all().size(), 1U);
  const auto expectRefusal = [&](const std::string& path, const std::string& words) {
    testing::expectError([&] { openForReading(path); }, path, words);
    testing::expectError([&] { openForReading(path, Access::Read); }, path, words);
  };
  expectRefusal(make("session.db",
                     [](Store& store) {
                       store.sessions().put(Session{"../x", "", "", "", 1, true});
                     }),
                "in table session, id \"../x\"");
  expectRefusal(make("map.db",
                     [](Store& store) {
                       store.sessions().put(Anchor{kId, "../x", 0, {}});
                     }),
                "in table anchor, map \"../x\"");
  expectRefusal(make("model.db",
                     [](Store& store) {
                       TableStore<StoredModel>(store).put({kId, "../x", "s", "b"});
                     }),
                "in table model, hash \"../x\"");
  expectRefusal(make("edge.db",
                     [](Store& store) {
                       Edge edge;
                       edge.a.session = kId;
                       edge.b.session = "../x";
                       store.graph().put(edge);
                     }),
                "in table edge, session_b \"../x\"");
}

}  // namespace
}  // namespace urban_nav_store
