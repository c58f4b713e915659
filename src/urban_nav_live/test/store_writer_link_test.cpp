// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/store_writer_link.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_live {
namespace {

namespace fs = std::filesystem;
using urban_nav_store::Access;
using urban_nav_store::Session;
using urban_nav_store::Store;

class StoreWriterLinkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "store_writer_link_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  StoreWriterLink::Options options(StoreWriterLink::EmptyPath empty_path = StoreWriterLink::EmptyPath::NoStore) {
    StoreWriterLink::Options made;
    made.empty_path = empty_path;
    made.now = [this] { return now; };
    return made;
  }
  static void put(Store& store) {
    Session session;
    session.id = "0123456789abcdef0123";
    session.name = "monday";
    store.sessions().put(session);
  }

  fs::path folder;
  StoreWriterLink::Clock::time_point now{};
};

TEST_F(StoreWriterLinkTest, WritesToTheStore) {
  const std::string path = folder / "a.db";
  {
    StoreWriterLink link(path, options());
    EXPECT_FALSE(link.isOpen());
    EXPECT_TRUE(link.open());
    EXPECT_FALSE(link.open()) << "it is open";
    link.post(put);
    link.flush();
    EXPECT_EQ(link.state().committed, 1);
    EXPECT_EQ(link.state().fault, "");
    EXPECT_EQ(link.state().path, path);
  }
  Store store(path, Access::Read);
  EXPECT_EQ(store.sessions().all().size(), 1U);
}

TEST_F(StoreWriterLinkTest, ReadsWhatTheStoreHasBeforeItWrites) {
  const std::string path = folder / "a.db";
  {
    Store store(path, Access::Write);
    put(store);
    store.commit();
  }
  StoreWriterLink link(path, options());
  std::size_t sessions = 0;
  EXPECT_TRUE(link.open([&](Store& store) { sessions = store.sessions().all().size(); }));
  EXPECT_EQ(sessions, 1U);
}

TEST_F(StoreWriterLinkTest, NamesAFaultAndRetriesAfterAPause) {
  const std::string path = folder / "a.db";
  std::ofstream(path) << "no data base";
  StoreWriterLink link(path, options());
  EXPECT_FALSE(link.open());
  EXPECT_NE(link.state().fault.find("a.db"), std::string::npos) << link.state().fault;
  fs::remove(path);
  now += std::chrono::seconds(9);
  EXPECT_FALSE(link.open()) << "too early";
  now += std::chrono::seconds(1);
  EXPECT_TRUE(link.open());
  EXPECT_EQ(link.state().fault, "");
}

TEST_F(StoreWriterLinkTest, AnErrorOfTheReaderIsAFault) {
  StoreWriterLink link(folder / "a.db", options());
  EXPECT_FALSE(link.open([](Store&) { throw urban_nav_core::DataError("a.db", "damaged", ""); }));
  EXPECT_FALSE(link.isOpen());
  EXPECT_NE(link.state().fault.find("damaged"), std::string::npos);
}

TEST_F(StoreWriterLinkTest, DemandsAnAbsolutePath) {
  StoreWriterLink link("a.db", options());
  EXPECT_FALSE(link.open());
  EXPECT_NE(link.state().fault.find("absolute"), std::string::npos);
  EXPECT_FALSE(fs::exists("a.db"));
}

TEST_F(StoreWriterLinkTest, WithoutAPathNothingIsStored) {
  StoreWriterLink link("", options());
  EXPECT_FALSE(link.open());
  EXPECT_EQ(link.state().fault, "");
  EXPECT_EQ(link.state().path, "");
}

TEST_F(StoreWriterLinkTest, ATemporaryFileGoesWithTheLink) {
  fs::path file;
  {
    StoreWriterLink link("", options(StoreWriterLink::EmptyPath::TemporaryFile));
    EXPECT_TRUE(link.open());
    link.post(put);
    link.flush();
    file = link.path();
    EXPECT_TRUE(fs::exists(file));
  }
  EXPECT_FALSE(fs::exists(file));
  EXPECT_FALSE(fs::exists(file.parent_path()));
}

TEST_F(StoreWriterLinkTest, CountsWritesThatAreLost) {
  StoreWriterLink link(folder / "a.db", options());
  link.post(put);
  EXPECT_EQ(link.state().lost, 1);
}

TEST_F(StoreWriterLinkTest, ReportsItsState) {
  StageReport without, with;
  addStoreFigures(StoreWriterLink("", options()).state(), without);
  EXPECT_EQ(without.figures.size(), 1U);
  addStoreFigures(StoreWriterLink(folder / "a.db", options()).state(), with);
  EXPECT_EQ(with.figures.size(), 6U);
}

}  // namespace
}  // namespace urban_nav_live
