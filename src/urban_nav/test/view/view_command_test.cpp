// SPDX-License-Identifier: BSD-3-Clause
// The command in a separate process: the printed address, termination by a signal, and errors.
#include <gtest/gtest.h>

#include <csignal>
#include <regex>

#include "edits/circle_store.hpp"
#include "support/child.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "view/http_client.hpp"
#include "view/http_server.hpp"

namespace urban_nav {
namespace {

using testing::Child;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;

class ViewCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    testing::writeCircleStore(shared_->file("s.db"));
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
  }
  static void TearDownTestSuite() { shared_.reset(); }

  std::string log() const { return readFile(folder_.file("log")); }
  std::optional<int> refused(const std::vector<std::string>& words) const {
    return Child(words, folder_.file("log")).endWithin(60.0);
  }

  static inline std::unique_ptr<TemporaryFolder> shared_;
  const TemporaryFolder folder_;
  const std::string store_ = shared_->file("s.db");
};

TEST_F(ViewCommand, PrintsItsAddressAndEndsWithASignal) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Child command({"view", store_, "--read-only"}, folder_.file("log"));
    const std::regex line("(^|\n)http://127\\.0\\.0\\.1:([0-9]+)/\\?token=([A-Za-z0-9_-]{16,})\n");
    std::smatch found;
    std::string text;
    for (int i = 0; i < 600 && !std::regex_search(text, found, line); ++i) {
      ::usleep(50'000);
      text = log();
    }
    if (found.empty()) {
      command.send(SIGKILL);
      command.endWithin(1.0);
      FAIL() << text;
    }
    const int port = std::stoi(found[2]);
    EXPECT_EQ(testing::sendRequest(port, "GET", "/?token=" + found[3].str()).status, 200);
    EXPECT_EQ(testing::sendRequest(port, "GET", "/").status, 403);
    command.send(signal);
    EXPECT_EQ(command.endWithin(60.0), 0) << log();
    EXPECT_FALSE(testing::RawConnection(port).isConnected());
  }
}

TEST_F(ViewCommand, RefusesWhatItCannotServe) {
  urban_nav_input::testing::writeFile(folder_.file("text.db"), "not a store\n");
  EXPECT_EQ(refused({"view", folder_.file("absent.db")}), 2);
  EXPECT_NE(log().find("absent.db"), std::string::npos) << log();
  EXPECT_EQ(refused({"view", folder_.file("text.db")}), 2);
  EXPECT_NE(log().find("text.db"), std::string::npos) << log();
  const HttpServer taken("127.0.0.1", 0);
  const std::string port = std::to_string(taken.port());
  EXPECT_EQ(refused({"view", store_, "--port", port}), 2);
  EXPECT_NE(log().find(port), std::string::npos) << log();
  for (const char* address : {"0.0.0.0", "::", "localhost", "192.0.2.1", "127.0.0.1:80"})
    EXPECT_EQ(refused({"view", store_, "--address", address}), 2) << address;
  for (const char* number : {"-1", "65536", "x"}) EXPECT_EQ(refused({"view", store_, "--port", number}), 2) << number;
}

}  // namespace
}  // namespace urban_nav
