// SPDX-License-Identifier: BSD-3-Clause
// kill -9 at any moment: everything committed before is present, and nothing else.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::Folder;

/// The n-th transaction, identical in every process.
void writeBatch(Store& store, int batch) {
  Drawn drawn(static_cast<std::uint32_t>(batch));
  const SessionId session = "crash";
  if (batch == 0) store.sessions().put(Session{session, "", "", "", 0, false});
  for (int i = 0; i < 10; ++i) {
    const urban_nav_core::StampNs stamp = (10LL * batch + i) * 50'000'000;
    store.graph().put(session, drawn.node(stamp));
    store.inputs().append(session, {"stereo", stamp, true});
    store.scans().put(session, "laser", drawn.scan(stamp, 30));
  }
  store.states().put(session, "stage", drawn.bytes(3000));
}

int batchesIn(Store& store) {
  const std::int64_t nodes = store.graph().nodes("crash");
  EXPECT_EQ(nodes % 10, 0) << "half a transaction";
  return static_cast<int>(nodes / 10);
}

/// Runs in another process: continues after the stored rows, and reports its progress after each commit.
[[noreturn]] void writeUntilKilled(const std::string& path, int tell) {
  Store store(path, Access::Write);
  for (int batch = batchesIn(store);; ++batch) {
    writeBatch(store, batch);
    store.commit();
    const int done = batch + 1;
    if (::write(tell, &done, sizeof done) != static_cast<ssize_t>(sizeof done)) ::_exit(1);
  }
}

TEST(Crash, WhatWasCommittedIsThere) {
  const Folder folder;
  const std::string path = folder.file("s.db"), reference = folder.file("reference.db");
  std::mt19937 random(1);
  Store expected(reference, Access::Write);
  int written = 0;
  for (int round = 0; round < 24; ++round) {
    int pipes[2];
    ASSERT_EQ(::pipe(pipes), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(pipes[0]);
      writeUntilKilled(path, pipes[1]);
    }
    ::close(pipes[1]);
    int reported = 0, number = 0;
    if (round % 3 != 0) {  // in one of three rounds it may be killed before it has opened the file
      ASSERT_EQ(::read(pipes[0], &number, sizeof number), static_cast<ssize_t>(sizeof number));
      reported = number;
    }
    ::usleep(static_cast<useconds_t>(random() % 30000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    while (::read(pipes[0], &number, sizeof number) == static_cast<ssize_t>(sizeof number)) reported = number;
    ::close(pipes[0]);
    if (!std::filesystem::exists(path)) continue;  // killed before the file was renamed
    int there = 0;
    std::string read;
    {
      Store store(path, Access::Read);
      there = batchesIn(store);
      read = dump(store);
    }
    EXPECT_GE(there, reported);
    EXPECT_LE(there, std::max(reported, written) + 1);
    EXPECT_GE(there, written) << "committed by an earlier round";
    for (; written < there; ++written) writeBatch(expected, written);
    expected.commit();
    EXPECT_TRUE(read == dump(expected));
    Store store(path, Access::Write);  // checkpoints the log
    EXPECT_TRUE(dump(store) == read);
  }
  EXPECT_GT(written, 10) << "otherwise the test is not meaningful";
}

}  // namespace
}  // namespace urban_nav_store
