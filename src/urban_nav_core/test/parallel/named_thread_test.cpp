// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parallel/named_thread.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

namespace urban_nav_core {
namespace {

std::string nameOfThisThread() {
  char name[16] = {};
  pthread_getname_np(pthread_self(), name, sizeof name);
  return name;
}

TEST(NamedThread, HasItsNameWhileItWorks) {
  std::string name;
  namedThread("read_ahead", [&] { name = nameOfThisThread(); }).join();
  EXPECT_EQ(name, "read_ahead");
}

TEST(NamedThread, ALongNameIsCut) {
  std::string name;
  namedThread("urban_nav_localization", [&] { name = nameOfThisThread(); }).join();
  EXPECT_EQ(name, "urban_nav_local");
}

}  // namespace
}  // namespace urban_nav_core
