// SPDX-License-Identifier: BSD-3-Clause
// A damaged store is reported, or the damaged part is unused: no crash, and no wrong data.
#include <gtest/gtest.h>

#include <random>

#include "dump_tables.hpp"
#include "schema/schema.hpp"
#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::catchError;
using testing::fill;
using testing::Folder;
using testing::readFile;
using testing::writeFile;

/// Size of the pages of a file, from its header.
std::size_t pageSize(const std::string& bytes) {
  return static_cast<std::size_t>(static_cast<unsigned char>(bytes[16])) << 8 |
         static_cast<std::size_t>(static_cast<unsigned char>(bytes[17]));
}

class Damage : public ::testing::Test {
 protected:
  Damage() {
    Store store(path, Access::Write);
    fill(store, 1, 60);
    fill(store, 2, 5);
    store.commit();
    whole = dump(store);
    store.close();
    bytes = readFile(path);
    page_size = pageSize(bytes);
  }

  /// Result of reading a damaged file: all data, or an error that names it.
  enum class Outcome { Same, Refused, Other };
  template <typename Read>
  Outcome makeOutcome(const Read& read) {
    std::string text;
    const std::string error = catchError([&] { text = read(); });
    if (error.empty()) return text == whole ? Outcome::Same : Outcome::Other;
    return error.rfind(path, 0) == 0 ? Outcome::Refused : Outcome::Other;
  }
  Outcome opened() {
    return makeOutcome([&] {
      Store store(path, Access::Read);
      return dump(store);
    });
  }
  /// Reads like a large store, which is not completely checked when opened.
  Outcome readOnly() {
    return makeOutcome([&] {
      Connection connection(path, Connection::Mode::ReadFrozen);
      schema::check(connection);
      return dumpTables(connection);
    });
  }

  const Folder folder;
  const std::string path = folder.file("s.db");
  std::string bytes, whole;
  std::size_t page_size = 0;
};

TEST_F(Damage, OfAnyPageIsNamed) {
  ASSERT_GT(bytes.size(), 60 * page_size);
  for (std::size_t page = 0; page < bytes.size() / page_size; ++page) {
    for (const char fill_with : {'\0', '\xff', '\x5a'}) {
      std::string damaged = bytes;
      damaged.replace(page * page_size, page_size, page_size, fill_with);
      writeFile(path, damaged);
      EXPECT_NE(opened(), Outcome::Other) << "page " << page;
      EXPECT_NE(readOnly(), Outcome::Other) << "page " << page;
    }
    std::string exchanged = bytes;
    const std::size_t next = (page + 1) % (bytes.size() / page_size);
    exchanged.replace(page * page_size, page_size, bytes.substr(next * page_size, page_size));
    writeFile(path, exchanged);
    EXPECT_NE(opened(), Outcome::Other) << "page " << page;
    EXPECT_NE(readOnly(), Outcome::Other) << "page " << page;
  }
}

TEST_F(Damage, OfAnyByteIsNamed) {
  std::mt19937 random(1);
  int same = 0, refused = 0;
  for (int i = 0; i < 400; ++i) {
    // Half of them within the structure of a page.
    const std::size_t page = random() % (bytes.size() / page_size);
    const std::size_t at = page * page_size + random() % (i % 2 == 0 ? 100 : page_size);
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1U << random() % 8U));
    writeFile(path, damaged);
    const Outcome outcome = i % 4 < 2 ? opened() : readOnly();
    EXPECT_NE(outcome, Outcome::Other) << "byte " << at;
    ++(outcome == Outcome::Same ? same : refused);
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(same, 0) << "free space is not in use";
}

TEST_F(Damage, AFileThatIsCutOffIsNamed) {
  for (std::size_t size = 1; size < bytes.size(); size += 3001) {
    writeFile(path, bytes.substr(0, size));
    EXPECT_EQ(opened(), Outcome::Refused) << size;
  }
}

TEST_F(Damage, ADamagedStoreIsNotWrittenTo) {
  std::string damaged = bytes;
  damaged.replace(5 * page_size, page_size, page_size, '\xff');
  writeFile(path, damaged);
  EXPECT_NE(catchError([&] { Store(path, Access::Write); }).find("is damaged"), std::string::npos);
  EXPECT_EQ(readFile(path), damaged);
  removeStore(path);
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace urban_nav_store
