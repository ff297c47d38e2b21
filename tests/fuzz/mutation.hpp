/// Damages bytes at random as libFuzzer does, without its coverage: the same seed gives the same bytes.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace solidus::fuzz {

/// A source of damaged inputs.
class Mutation {
 public:
  /// @param corpus  inputs to set out from, at least one
  /// @param words   words that the reader under test knows, which are put in
  Mutation(std::vector<std::string> corpus, std::vector<std::string> words, std::uint64_t seed)
      : corpus_(std::move(corpus)), words_(std::move(words)), random_(seed) {}

  /// One of the corpus with one to eight damages, at most `k_longest` bytes.
  std::string next();

 private:
  static constexpr std::size_t k_longest = 40000;

  std::size_t below(std::size_t n) { return random_() % n; }
  void damage(std::string& text);
  void replace_number(std::string& text);
  void splice(std::string& text);

  std::vector<std::string> corpus_, words_;
  std::mt19937_64 random_;  // whose numbers the standard prescribes, those of distributions it does not
};

}  // namespace solidus::fuzz
