// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/agreement_cache.hpp"

#include <gtest/gtest.h>

namespace fabmap_node {
namespace {

AgreementCache::Agreement withShare(double share) {
  AgreementCache::Agreement agreement;
  agreement.share = share;
  return agreement;
}

TEST(AgreementCache, DistinguishesPairs) {
  AgreementCache cache;
  cache.beginMap({0, 1});
  cache.keep({1, 100}, {0, 7}, 1, withShare(0.25));
  cache.keep({1, 100}, {0, 7}, 4, withShare(0.5));
  EXPECT_EQ(cache.find({1, 100}, {0, 7}, 1)->share, 0.25);
  EXPECT_EQ(cache.find({1, 100}, {0, 7}, 4)->share, 0.5) << "every fourth descriptor";
  EXPECT_FALSE(cache.find({0, 7}, {1, 100}, 1)) << "the other order";
  EXPECT_FALSE(cache.find({1, 100}, {1, 7}, 1)) << "another session";
  EXPECT_FALSE(cache.find({1, 101}, {0, 7}, 1));
  EXPECT_EQ(cache.pairs(), 2U);
}

TEST(AgreementCache, SessionsHaveTheirNumbersInAnotherMap) {
  AgreementCache cache;
  cache.beginMap({3, 5});
  cache.keep({1, 100}, {0, 7}, 1, withShare(0.25));
  cache.beginMap({5, 4, 3});
  EXPECT_EQ(cache.find({0, 100}, {2, 7}, 1)->share, 0.25);
  EXPECT_FALSE(cache.find({1, 100}, {0, 7}, 1));
}

}  // namespace
}  // namespace fabmap_node
