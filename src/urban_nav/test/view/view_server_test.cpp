// SPDX-License-Identifier: BSD-3-Clause
// The server of the page on a real port: its answers to pages, to other programs, and to bytes that are no request.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

#include "edits/circle_store.hpp"
#include "edits/edge_list.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "view/http_server.hpp"
#include "view/served_store.hpp"

namespace urban_nav {
namespace {

using testing::RawAnswer;
using testing::RawConnection;
using testing::sendRequest;
using testing::ServedStore;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr const char* kJsonType = "Content-Type: application/json\r\n";
constexpr const char* kHostileName = "<img src=x onerror=alert(1)>'\"&";

class ViewServer : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    testing::writeCircleStore(shared_->file("first.db"));
    Store store(shared_->file("first.db"), Access::Write);
    urban_nav_store::Session monday = *store.sessions().find(testing::kMondayId);
    monday.name = kHostileName;
    store.sessions().put(monday);
    store.commit();
  }
  static void TearDownTestSuite() { shared_.reset(); }

  ViewServer() { std::filesystem::copy_file(shared_->file("first.db"), store_); }

  static inline std::unique_ptr<TemporaryFolder> shared_;
  const TemporaryFolder folder_;
  const std::string store_ = folder_.file("s.db");
};

TEST_F(ViewServer, ThePageNeedsNothingFromElsewhere) {
  const ServedStore served(store_);
  const RawAnswer page = sendRequest(served.port(), "GET", "/?token=" + served.token());
  EXPECT_EQ(page.status, 200);
  EXPECT_NE(page.head.find("X-Frame-Options: DENY"), std::string::npos) << page.head;
  EXPECT_NE(page.body.find("data-action=\"reject\""), std::string::npos);
  for (const char* words : {"src=\"http", "href=\"http", "NONCE", "<!-- scripts -->", "<!-- style -->"})
    EXPECT_EQ(page.body.find(words), std::string::npos) << words;
  EXPECT_EQ(page.body.find(served.token()), std::string::npos) << "a token in the page could be kept with it";
  EXPECT_EQ(sendRequest(served.port(), "HEAD", "/?token=" + served.token()).body, "");
}

TEST_F(ViewServer, RefusesOtherProgramsWithoutAWord) {
  const ServedStore served(store_);
  const std::string with_token = "/?token=" + served.token(), port = std::to_string(served.port());
  const std::string bytes = readFile(store_);
  const auto expectRefused = [&](const RawAnswer& answer) {
    EXPECT_EQ(answer.status, 403) << answer.head;
    EXPECT_EQ(answer.body, "");
    EXPECT_EQ(answer.head.find(served.token()), std::string::npos);
  };
  for (const char* path : {"/", "/api/state", "/api/paths", "/api/why?id=1", "/api/events", "/nowhere",
                           "/?token=", "/?token=x", "/api/../api/state"})
    expectRefused(sendRequest(served.port(), "GET", path));
  expectRefused(
      sendRequest(served.port(), "POST", "/api/edit", kJsonType, R"({"action": "reject", "arguments": ["3"]})"));
  expectRefused(sendRequest(served.port(), "OPTIONS", "/api/edit", "Origin: http://evil.example\r\n"));
  expectRefused(sendRequest(served.port(), "GET", with_token, "Host: evil.example:" + port + "\r\n"));
  expectRefused(sendRequest(served.port(), "GET", with_token, "Origin: http://evil.example\r\n"));
  expectRefused(sendRequest(served.port(), "GET", with_token, "Origin: null\r\n"));
  expectRefused(
      sendRequest(served.port(), "POST", "/api/edit?token=" + served.token(),
                  std::string(kJsonType) + "Origin: http://127.0.0.1:" + std::to_string(served.port() + 1) + "\r\n",
                  R"({"action": "reject", "arguments": ["3"]})"));
  EXPECT_TRUE(bytes == readFile(store_));
}

TEST_F(ViewServer, NamesNoFile) {
  const ServedStore served(store_);
  for (const char* path : {"/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/web/page.js", "/etc/passwd",
                           "/api/state/../../x", "/api/picture", "/s.db", "//etc/passwd", "/%00", "/page.html"}) {
    const RawAnswer answer = served.get(path);
    EXPECT_TRUE(answer.status == 404 || answer.status == 400) << path << ": " << answer.status;
    EXPECT_EQ(answer.body.find("root:"), std::string::npos) << path;
  }
  for (const char* path : {"/api/why", "/api/why?id=", "/api/why?id=-1", "/api/why?id=x", "/api/why?id=99999",
                           "/api/why?id=1&id=2", "/api/picture?id=1", "/api/why?id=99999999999999999999"})
    EXPECT_EQ(served.get(path).status, 400) << path;
}

TEST_F(ViewServer, ShowsNamesFromOutsideAsData) {
  const ServedStore served(store_);
  const RawAnswer state = served.get("/api/state");
  EXPECT_EQ(state.status, 200);
  EXPECT_NE(state.head.find("application/json"), std::string::npos);
  EXPECT_NE(state.head.find("nosniff"), std::string::npos);
  EXPECT_NE(state.body.find(R"("name": "<img src=x onerror=alert(1)>'\"&")"), std::string::npos) << state.body;
  EXPECT_EQ(served.get("/").body.find("onerror"), std::string::npos);
  const RawAnswer why = served.get("/api/why?id=1");
  EXPECT_EQ(why.status, 200);
  EXPECT_NE(why.body.find("closure 1"), std::string::npos) << why.body;
  EXPECT_EQ(served.get("/api/picture?id=1&number=0").status, 204) << "the closures of this store have no views";
  EXPECT_EQ(served.get("/api/paths").body.size(), 16U * (901 + 401)) << "four numbers for each pose";
}

TEST_F(ViewServer, AnEditIsThatOfTheCommand) {
  const ServedStore served(store_);
  const RawAnswer edited = served.edit(R"({"action": "reject", "arguments": ["3"]})");
  EXPECT_EQ(edited.status, 200) << edited.body;
  EXPECT_NE(edited.body.find("\"changed\": true"), std::string::npos) << edited.body;
  EXPECT_NE(edited.body.find("; poses moved by up to"), std::string::npos) << edited.body;
  const RawAnswer state = served.get("/api/state");
  EXPECT_NE(state.body.find("\"command\": \"reject 3\""), std::string::npos) << state.body;
  EXPECT_NE(state.body.find("\"revision\": 2"), std::string::npos);
  const RawAnswer again = served.edit(R"({"action": "reject", "arguments": ["3"]})");
  EXPECT_NE(again.body.find("\"changed\": false"), std::string::npos) << again.body;
  EXPECT_NE(served.get("/api/state").body.find("\"revision\": 2"), std::string::npos) << "nothing changed";
  EXPECT_EQ(served.edit(R"({"action": "undo"})").status, 200);
  Store store(store_, Access::Read);
  const std::vector<ListedEdit> edits = listEdits(store);
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_TRUE(edits.front().undone && edits.front().redoable);
}

TEST_F(ViewServer, RefusesBadEditsAndLeavesTheStore) {
  const ServedStore served(store_);
  const std::string bytes = readFile(store_);
  for (const char* body :
       {"{", "null", R"({"action": "reject"})", R"({"action": "reject", "arguments": ["99999"]})",
        R"({"action": "reject", "arguments": ["first"]})", R"({"action": "undo", "arguments": ["0"]})",
        R"({"action": "measure", "arguments": ["99999999.5", "2"]})",
        R"({"action": "pin", "arguments": ["+5"], "options": {"at": "1,2"}})"}) {
    const RawAnswer answer = served.edit(body);
    EXPECT_EQ(answer.status, 400) << body;
    EXPECT_NE(answer.body.find("\"error\": "), std::string::npos) << answer.body;
  }
  EXPECT_EQ(served.edit(std::string(kLargestBody + 1, ' ')).status, 413);
  EXPECT_EQ(sendRequest(served.port(), "POST", "/api/state",
                        kJsonType + ("X-Urban-Nav-Token: " + served.token() + "\r\n"), "{}")
                .status,
            404);
  EXPECT_TRUE(bytes == readFile(store_));
  const Store writer(store_, Access::Write);
  const RawAnswer busy = served.edit(R"({"action": "reject", "arguments": ["3"]})");
  EXPECT_EQ(busy.status, 409);
  EXPECT_NE(busy.body.find("another program"), std::string::npos) << busy.body;
  EXPECT_NE(served.get("/api/state").body.find("\"written_by_another\": true"), std::string::npos);
}

TEST_F(ViewServer, ComparesWithAnotherStore) {
  const std::string before = folder_.file("before.db");
  std::filesystem::copy_file(store_, before);
  ServedStore served(store_, false, before);
  const auto stated = [&] {
    const std::string state = served.get("/api/state").body;
    double largest = -1.0;
    for (std::size_t at = 0; (at = state.find("\"largest_m\": ", at)) != std::string::npos; ++at)
      largest = std::max(largest, std::stod(state.substr(at + 13)));
    return largest;
  };
  EXPECT_EQ(stated(), 0.0) << "the same store";
  ASSERT_EQ(served.edit(R"({"action": "reject", "arguments": ["3"]})").status, 200);
  const std::string there = served.get("/api/compared").body, here = served.get("/api/paths").body;
  ASSERT_EQ(there.size() / 12, here.size() / 16) << "three numbers for each pose";
  double largest = 0.0;
  for (std::size_t i = 0; i < there.size() / 12; ++i) {
    float a[3], b[3];
    std::memcpy(a, there.data() + 12 * i, sizeof a);
    std::memcpy(b, here.data() + 16 * i + 4, sizeof b);
    largest = std::max<double>(largest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  EXPECT_GT(largest, 1e-5) << "the edit moved the map";
  EXPECT_NEAR(stated(), largest, 2e-5);
  {
    Store other(before, Access::Write);
    urban_nav_store::Session monday = *other.sessions().find(testing::kMondayId);
    monday.name = "renamed";
    other.sessions().put(monday);
    other.commit();
  }
  served.source().poll();
  EXPECT_NE(served.get("/api/state").body.find("\"revision\": 3"), std::string::npos) << "the other store has changed";
}

TEST_F(ViewServer, AMeasurementIsTriedWithoutAnEdit) {
  const ServedStore served(store_, true);
  const std::string bytes = readFile(store_);
  const RawAnswer tried = served.get("/api/try?t1=tuesday%2B3&t2=tuesday%2B5");
  EXPECT_EQ(tried.status, 200) << tried.body;
  EXPECT_NE(tried.body.find("\"accepted\": false"), std::string::npos) << "this store has no views: " << tried.body;
  EXPECT_NE(tried.body.find("the pair is not accepted"), std::string::npos) << tried.body;
  EXPECT_EQ(served.get("/api/picture?id=0&number=0").status, 204);
  EXPECT_EQ(served.get("/api/view?session=1&seconds=3.5").status, 204);
  for (const char* moment : {"session=9&seconds=1", "session=0&seconds=nan", "session=0&seconds=1e300", "session=0"})
    EXPECT_EQ(served.get(std::string("/api/view?") + moment).status, 400) << moment;
  for (const char* moments : {"t1=tuesday%2B3", "t1=tuesday%2B3&t2=tuesday%2B3", "t1=never&t2=tuesday%2B3"})
    EXPECT_EQ(served.get(std::string("/api/try?") + moments).status, 400) << moments;
  EXPECT_TRUE(bytes == readFile(store_));
}

TEST_F(ViewServer, ReadOnlyRefusesEdits) {
  const ServedStore served(store_, true);
  const std::string bytes = readFile(store_);
  EXPECT_NE(served.get("/api/state").body.find("\"read_only\": true"), std::string::npos);
  EXPECT_EQ(served.edit(R"({"action": "reject", "arguments": ["3"]})").status, 400);
  EXPECT_TRUE(bytes == readFile(store_));
}

TEST_F(ViewServer, PagesFollowEditsOfEachOtherAndOfTheCommand) {
  ServedStore served(store_);
  const RawConnection page(served.port());
  page.send("GET /api/events?token=" + served.token() +
            " HTTP/1.1\r\nHost: localhost:" + std::to_string(served.port()) + "\r\n\r\n");
  const std::string first = page.readUntil("\"revision\": 1");
  EXPECT_NE(first.find("text/event-stream"), std::string::npos) << first;
  ASSERT_EQ(served.edit(R"({"action": "reject", "arguments": ["3"]})").status, 200);
  const std::string second = page.readUntil("\"revision\": 2");
  EXPECT_NE(second.find("\"running\": \"reject 3\""), std::string::npos) << second;
  EXPECT_NE(second.find("edit 1 applied"), std::string::npos) << second;
  {
    Store store(store_, Access::Write);
    urban_nav_store::EditJournal(store).undo(1);
    store.commit();
  }
  served.source().poll();
  EXPECT_NE(page.readUntil("\"revision\": 3").find("\"revision\": 3"), std::string::npos);
  EXPECT_NE(served.get("/api/state").body.find("\"undone\": true"), std::string::npos);
}

TEST_F(ViewServer, AnswersManyAtOnceAndMakesEditsOneByOne) {
  const ServedStore served(store_);
  std::atomic<int> changed{0}, wrong{0};
  std::vector<std::thread> pages;
  for (int page = 0; page < 6; ++page)
    pages.emplace_back([&, page] {
      const RawAnswer edit =
          served.edit(R"({"action": "reject", "arguments": [")" + std::to_string(1 + page % 3) + "\"]}");
      EXPECT_EQ(edit.status, 200) << edit.body;
      if (edit.body.find("\"changed\": true") != std::string::npos) ++changed;
      for (int i = 0; i < 10; ++i)
        if (served.get(i % 2 == 0 ? "/api/state" : "/api/paths").status != 200) ++wrong;
    });
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(changed, 3) << "three closures, each rejected once";
}

TEST_F(ViewServer, SurvivesBytesThatAreNoRequest) {
  const ServedStore served(store_);
  std::mt19937 random(5);
  const std::string valid = "POST /api/edit?token=" + served.token() +
                            " HTTP/1.1\r\nHost: localhost:" + std::to_string(served.port()) + "\r\n" + kJsonType +
                            "Content-Length: 18\r\nConnection: close\r\n\r\n{\"action\": \"redo\"}";
  for (int round = 0; round < 150; ++round) {
    std::string bytes = valid;
    for (int change = static_cast<int>(random() % 4); change >= 0; --change) {
      const std::size_t at = random() % bytes.size();
      if (random() % 2 == 0) bytes[at] = static_cast<char>(random());
      else bytes.erase(at, 1 + random() % 20);
    }
    const RawConnection connection(served.port());
    connection.send(bytes);
    ::shutdown(connection.socket(), SHUT_WR);
    connection.readAll();
  }
  const RawConnection huge(served.port());
  huge.send("GET /" + std::string(100'000, 'a') + " HTTP/1.1\r\n\r\n");
  EXPECT_NE(huge.readAll().find(" 414 "), std::string::npos);
  EXPECT_EQ(served.get("/api/state").status, 200);
  Store store(store_, Access::Read);
  EXPECT_TRUE(listEdits(store).empty());
}

TEST_F(ViewServer, EndsWhilePagesAreOpen) {
  std::vector<std::unique_ptr<RawConnection>> pages;
  {
    const ServedStore served(store_);
    for (int page = 0; page < 3; ++page) {
      pages.push_back(std::make_unique<RawConnection>(served.port()));
      pages.back()->send("GET /api/events?token=" + served.token() +
                         " HTTP/1.1\r\nHost: localhost:" + std::to_string(served.port()) + "\r\n\r\n");
      EXPECT_NE(pages.back()->readUntil("revision").find("revision"), std::string::npos);
    }
  }
  for (const auto& page : pages) page->readAll();
}

TEST(HttpServerPort, ThatIsInUseIsNamed) {
  const HttpServer first("127.0.0.1", 0);
  try {
    const HttpServer second("127.0.0.1", first.port());
    ADD_FAILURE() << "two servers at one port";
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(first.port())), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace urban_nav
