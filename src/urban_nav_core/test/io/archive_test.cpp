// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/archive.hpp"

#include <limits>

#include "io/reader_check.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace urban_nav_core {
namespace {

enum class Colour : std::uint8_t { Red, Green };

struct Inner {
  std::vector<float> samples;
  std::optional<Matrix6d> information;
  void archive(Archive& archive) { archive(samples, information); }
};

/// Members of all supported types.
struct Thing {
  bool yes = false;
  int small = 0;
  std::int64_t large = 0;
  std::uint8_t byte = 0;
  Colour colour = Colour::Red;
  double number = 0.0;
  std::string text;
  Pose pose;
  std::array<std::uint8_t, 3> pixels{};
  std::vector<std::pair<std::int64_t, double>> pairs;
  std::vector<Inner> inners;
  Status status;
};
void archive(Archive& archive, Thing& thing) {
  archive(thing.yes, thing.small, thing.large, thing.byte, thing.colour, thing.number, thing.text, thing.pose);
  archive(thing.pixels, thing.pairs, thing.inners, thing.status);
}

Thing someThing() {
  Thing thing;
  thing.yes = true;
  thing.small = -7;
  thing.large = std::numeric_limits<std::int64_t>::min() / 2;
  thing.byte = 255;
  thing.colour = Colour::Green;
  thing.number = -0.1;
  thing.text = std::string("nought \0 within", 15);
  thing.pose = expSe3((Vector6d() << 1.0, -2.0, 3.0, 0.4, 0.5, -0.6).finished());
  thing.pixels = {1, 2, 200};
  thing.pairs = {{4, 5.5}, {-6, 1e-300}};
  thing.inners.resize(2);
  thing.inners[0].samples = {1.5F, -2.25F};
  thing.inners[1].information = 3.0 * Matrix6d::Identity();
  thing.status = {Health::Lost, 4, "dark"};
  return thing;
}

std::string written(Thing thing) {
  Archive archive;
  archive(thing);
  return archive.take();
}

Thing read(std::string_view bytes) {
  Thing thing = someThing();  // previous content must not matter
  Archive archive(bytes, "state of a thing");
  archive(thing);
  archive.finish();
  return thing;
}

TEST(Archive, WhatIsWrittenIsRead) {
  const std::string bytes = written(someThing());
  const Thing thing = read(bytes);
  EXPECT_EQ(written(thing), bytes);
  EXPECT_EQ(thing.large, std::numeric_limits<std::int64_t>::min() / 2);
  EXPECT_EQ(thing.text.size(), 15U);
  EXPECT_EQ(thing.colour, Colour::Green);
  ASSERT_EQ(thing.inners.size(), 2U);
  EXPECT_EQ(thing.inners[0].samples, (std::vector<float>{1.5F, -2.25F}));
  EXPECT_FALSE(thing.inners[0].information);
  EXPECT_EQ((*thing.inners[1].information)(5, 5), 3.0);
  EXPECT_EQ(thing.pose.q().coeffs(), someThing().pose.q().coeffs());
  EXPECT_EQ(written(read(written(Thing()))), written(Thing()));
}

TEST(Archive, IsLittleEndian) {
  Archive archive;
  int number = 0x01020304;
  double one = 1.0;
  archive(number, one);
  EXPECT_EQ(archive.take(), std::string("\x04\x03\x02\x01\0\0\0\0\0\0\0\0\0\0\xf0\x3f", 16));
}

TEST(Archive, NamesWhatIsWrong) {
  const std::string bytes = written(someThing());
  EXPECT_EQ(catchError([&] { read(bytes.substr(0, bytes.size() - 1)); }),
            "state of a thing: is damaged: it has fewer elements than its count");
  EXPECT_EQ(catchError([&] { read(bytes.substr(0, 20)); }), "state of a thing: is damaged: it is truncated");
  EXPECT_EQ(catchError([&] { read(bytes + "x"); }), "state of a thing: is damaged: it has trailing bytes");
  std::string other = bytes;
  other[0] = 2;
  EXPECT_EQ(catchError([&] { read(other); }), "state of a thing: is damaged: an integer is out of range");
  Thing thing;
  thing.small = std::numeric_limits<int>::max();
  EXPECT_EQ(catchError([&] { read(written(thing)); }), "state of a thing: is damaged: an integer is out of range");
  other = bytes;
  other[5 * 8 + 6] = other[5 * 8 + 7] = '\x7f';
  other[5 * 8 + 6] = '\xf0';
  EXPECT_EQ(catchError([&] { read(other); }), "state of a thing: is damaged: a number is not finite");
}

TEST(Archive, SealsAgainstDamage) {
  const std::string sealed = seal("thing", 3, "content");
  EXPECT_EQ(unseal("thing", 3, sealed), "content");
  EXPECT_EQ(catchError([&] { unseal("thing", 4, sealed); }), "state of thing: is of version 3: expected version 4");
  EXPECT_EQ(catchError([&] { unseal("other", 3, sealed); }),
            "state of other: is the state of thing: expected one of other");
  EXPECT_EQ(catchError([&] { unseal("thing", 3, "{}"); }), "state of thing: is not a saved state");
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    std::string damaged = sealed;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_NE(catchError([&] { unseal("thing", 3, damaged); }), "") << i;
    EXPECT_NE(catchError([&] { unseal("thing", 3, sealed.substr(0, i)); }), "") << i;
  }
}

TEST(Archive, UnsealsARangeOfVersions) {
  const std::string sealed = seal("thing", 3, "content");
  for (const auto& [oldest, newest] : {std::pair<std::uint32_t, std::uint32_t>{1, 3}, {3, 5}, {3, 3}}) {
    const UnsealedState state = unseal("thing", oldest, newest, sealed);
    EXPECT_EQ(state.version, 3U);
    EXPECT_EQ(state.content, "content");
  }
  EXPECT_EQ(catchError([&] { unseal("thing", 1, 2, sealed); }),
            "state of thing: is of version 3: expected version 1...2");
  EXPECT_EQ(catchError([&] { unseal("thing", 4, 6, sealed); }),
            "state of thing: is of version 3: expected version 4...6");
  EXPECT_TRUE(isSealed(sealed));
  EXPECT_FALSE(isSealed(sealed.substr(1)));
  EXPECT_FALSE(isSealed(""));
}

TEST(Archive, Fuzzed) {
  expectSurvives(testing::fuzzText({written(someThing()), written(Thing())},
                                   [](const std::string& bytes) { EXPECT_TRUE(written(read(bytes)) == bytes); }));
}

}  // namespace
}  // namespace urban_nav_core
