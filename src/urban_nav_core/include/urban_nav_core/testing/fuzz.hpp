// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace urban_nav_core::testing {

/// Damages files while keeping most of their structure, so that a reader is tested beyond its first check: bytes,
/// numbers (too large, not finite, negative, followed by garbage), words, lines and ends; pieces of one seed in
/// another. Deterministic for the same seed.
class Mutator {
 public:
  /// `seeds`: at least one valid file.
  Mutator(std::vector<std::string> seeds, std::uint64_t seed);
  std::string next();

 private:
  void mutateOnce(std::string& text);
  std::size_t below(std::size_t limit);

  std::vector<std::string> seeds_;
  std::mt19937_64 random_;
};
/// Outcomes of a fuzzed reader.
struct FuzzResult {
  int accepted = 0;     ///< texts that the reader accepted
  int refused = 0;      ///< texts that it rejected with a UserError
  std::string failure;  ///< empty, or the unexpected exception and the text that caused it
};

/// Returns the seconds to fuzz one reader: the environment's URBAN_NAV_FUZZ_SECONDS, else 0.3.
double fuzzSeconds();

/// Passes damaged texts to `read` for fuzzSeconds(), the undamaged seeds first. A reader may return or throw UserError;
/// any other exception ends the run with `failure`. Errors of memory or arithmetic are detected by sanitizers.
FuzzResult fuzzText(const std::vector<std::string>& seeds, const std::function<void(const std::string& text)>& read,
                    std::uint64_t seed = 1);

/// Fuzzes a reader of files; the file is called `name` and is in a temporary folder that is removed afterwards.
FuzzResult fuzzFile(const std::vector<std::string>& seeds, const std::string& name,
                    const std::function<void(const std::string& path)>& read, std::uint64_t seed = 1);

}  // namespace urban_nav_core::testing
