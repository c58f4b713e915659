// SPDX-License-Identifier: BSD-3-Clause
#include "view/gate.hpp"

#include <gtest/gtest.h>

#include <set>

namespace urban_nav {
namespace {

/// A request that the gate admits, to be spoiled in one respect.
HttpRequest goodRequest(const Gate& gate) {
  HttpRequest request;
  request.method = "GET";
  request.path = "/";
  request.query.emplace("token", gate.token());
  request.headers.emplace("host", "127.0.0.1:8123");
  return request;
}

int admissionStatus(const Gate& gate, const HttpRequest& request) {
  const std::unique_ptr<HttpAnswer> refusal = gate.admit(request);
  if (!refusal) return 200;
  EXPECT_TRUE(refusal->status != 403 || refusal->body.empty());
  return refusal->status;
}

class GateToThePage : public ::testing::Test {
 protected:
  const Gate gate_{"127.0.0.1", 8123};
  HttpRequest request_ = goodRequest(gate_);

  void setHeader(const std::string& name, const std::string& value) {
    request_.headers.erase(name);
    request_.headers.emplace(name, value);
  }
};

TEST_F(GateToThePage, AdmitsTheTokenInAddressOrHeader) {
  EXPECT_EQ(admissionStatus(gate_, request_), 200);
  request_.query.clear();
  EXPECT_EQ(admissionStatus(gate_, request_), 403);
  setHeader("x-urban-nav-token", gate_.token());
  EXPECT_EQ(admissionStatus(gate_, request_), 200);
  setHeader("host", "LocalHost:8123");
  setHeader("origin", "http://localhost:8123");
  EXPECT_EQ(admissionStatus(gate_, request_), 200);
}

TEST_F(GateToThePage, RefusesEveryOtherToken) {
  std::set<std::string> wrong = {"", "x", gate_.token() + "x", gate_.token().substr(1), std::string(32, 'x')};
  for (std::size_t i = 0; i < gate_.token().size(); ++i) {
    std::string one = gate_.token();
    one[i] = one[i] == 'A' ? 'B' : 'A';
    wrong.insert(one);
  }
  for (const std::string& token : wrong) {
    request_.query.clear();
    request_.query.emplace("token", token);
    EXPECT_EQ(admissionStatus(gate_, request_), 403) << token;
    setHeader("x-urban-nav-token", gate_.token());
    EXPECT_EQ(admissionStatus(gate_, request_), 403) << "a wrong one and the right one";
    request_.headers.erase("x-urban-nav-token");
  }
}

TEST_F(GateToThePage, RefusesOtherHostsAndOrigins) {
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:8124", "evil.example:8123", "127.0.0.1:8123.evil.example",
                           "localhost", "[::1]:8123", "127.0.0.1:08123"}) {
    setHeader("host", host);
    EXPECT_EQ(admissionStatus(gate_, request_), 403) << host;
  }
  request_.headers.erase("host");
  EXPECT_EQ(admissionStatus(gate_, request_), 403) << "none";
  request_.headers = {{"host", "127.0.0.1:8123"}, {"host", "127.0.0.1:8123"}};
  EXPECT_EQ(admissionStatus(gate_, request_), 403) << "two";
  setHeader("host", "127.0.0.1:8123");
  for (const char* origin : {"null", "", "http://evil.example", "http://127.0.0.1:8124", "https://127.0.0.1:8123",
                             "http://127.0.0.1", "127.0.0.1:8123", "http://127.0.0.1:8123.evil.example"}) {
    setHeader("origin", origin);
    EXPECT_EQ(admissionStatus(gate_, request_), 403) << origin;
  }
}

TEST_F(GateToThePage, RefusesMethodsAndBodiesThatThePageDoesNotUse) {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT"}) {
    request_.method = method;
    EXPECT_EQ(admissionStatus(gate_, request_), 405) << method;
  }
  request_.method = "POST";
  EXPECT_EQ(admissionStatus(gate_, request_), 415) << "no type";
  setHeader("content-type", "text/plain");
  EXPECT_EQ(admissionStatus(gate_, request_), 415);
  setHeader("content-type", "application/json; charset=utf-8");
  EXPECT_EQ(admissionStatus(gate_, request_), 200);
  setHeader("content-encoding", "gzip");
  EXPECT_EQ(admissionStatus(gate_, request_), 415);
  request_.headers.erase("content-encoding");
  setHeader("range", "bytes=0-1");
  EXPECT_EQ(admissionStatus(gate_, request_), 416);
}

TEST(Gate, NamesThePortOfHttpOnlyWhereItIsAnother) {
  const Gate gate("127.0.0.1", 80);
  HttpRequest request = goodRequest(gate);
  request.headers = {{"host", "localhost"}};
  EXPECT_EQ(admissionStatus(gate, request), 200);
  EXPECT_EQ(Gate("::1", 8123).pageAddress().rfind("http://[::1]:8123/?token=", 0), 0U);
}

TEST(Gate, DrawsTokensOfTheCharactersOfAnAddress) {
  std::set<std::string> tokens;
  std::set<char> characters;
  for (int i = 0; i < 200; ++i) {
    const std::string token = drawToken();
    EXPECT_EQ(token.size(), 32U);
    characters.insert(token.begin(), token.end());
    tokens.insert(token);
  }
  EXPECT_EQ(tokens.size(), 200U);
  EXPECT_EQ(characters.size(), 64U) << "6400 drawn: one of 64 is left out with probability e^-100";
  for (const char c : characters) EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-') << c;
}

TEST(Gate, ComparesTextsOfAnyLength) {
  EXPECT_TRUE(areEqualInConstantTime("", ""));
  EXPECT_TRUE(areEqualInConstantTime("abc", "abc"));
  for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{
           {"", "a"}, {"a", ""}, {"abc", "abd"}, {"abcabc", "abc"}, {"abc", "abcabc"}, {std::string("a\0b", 3), "a"}})
    EXPECT_FALSE(areEqualInConstantTime(one, other)) << one << " " << other;
}

}  // namespace
}  // namespace urban_nav
