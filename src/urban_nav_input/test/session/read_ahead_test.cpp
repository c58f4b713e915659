// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {
namespace {

class Counting : public Source {
 public:
  Counting(int count, bool fails) : count_(count), fails_(fails) {}
  const SourceInfo& info() const override { return info_; }
  std::optional<SourceItem> next() override {
    if (next_ == count_ && fails_) throw std::runtime_error("the disk is gone");
    if (next_ == count_) return std::nullopt;
    SourceItem input;
    input.assembled.pair.stamp = next_++;
    return input;
  }
  std::vector<std::string> closingFaults() const override { return {"last words"}; }

 private:
  SourceInfo info_;
  int count_, next_ = 0;
  bool fails_;
};

TEST(ReadAhead, KeepsOrderAndEnds) {
  const auto source = readAhead(std::make_unique<Counting>(100, false), 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(source->next()->assembled.pair.stamp, i);
  EXPECT_FALSE(source->next());
  EXPECT_FALSE(source->next());
  EXPECT_EQ(source->closingFaults(), std::vector<std::string>{"last words"});
}

TEST(ReadAhead, HandsOnWhatWasReadBeforeAnErrorAndThenTheError) {
  const auto source = readAhead(std::make_unique<Counting>(5, true), 2);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(source->next());
  EXPECT_THROW(source->next(), std::runtime_error);
}

TEST(ReadAhead, StopsWithoutReaders) { readAhead(std::make_unique<Counting>(1000000, false), 2)->next(); }

}  // namespace
}  // namespace urban_nav_input
