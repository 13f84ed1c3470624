// The plain matchers, compared with each other and with words that are easy to check.
#include "routes/oracle.h"

#include <gtest/gtest.h>

#include <regex>

#include "estimators.h"
#include "routes/random_routes.h"

namespace nephroid::oracle {
namespace {

Tree letter(const char* text) {
  return Tree::of(*atom_of(text, {}));
}

/// All words C e1 ... en l with up to `length` events, each once without and once with a mark.
std::vector<Word> words_over(const Alphabet& alphabet, int length) {
  std::vector<Word> prefixes{{alphabet.eye()}}, all;
  for (size_t i = 0; i < prefixes.size(); ++i)
    if (static_cast<int>(prefixes[i].size()) <= length)
      for (int e = 0; e < alphabet.events(); ++e) {
        prefixes.push_back(prefixes[i]);
        prefixes.back().push_back(alphabet.event(e));
      }
  for (const Word& prefix : prefixes)
    for (int l = 0; l < alphabet.lights(); l += 2) {
      all.push_back(prefix);
      all.back().push_back(alphabet.light(l));
      if (const size_t events = prefix.size() - 1; events > 0) {
        all.push_back(all.back());
        all.back()[1 + (all.size() % events)] += alphabet.events();
      }
    }
  return all;
}

TEST(Oracle, WritesWhatOneWouldWrite) {
  Atom merged = *atom_of("D", {});
  merged.marked = true;
  const Tree tree = Tree::sequence(
      {letter("C"), Tree::repeat(letter("."), 0, -1), Tree::of(merged),
       Tree::repeat(Tree::choice({letter("S"), letter("<TG>")}), 1, -1),
       Tree::repeat(letter("D"), 0, 1), Tree::repeat(letter("V"), 2, 4), letter("L")});
  EXPECT_EQ(tree.text(), "C.*D@(S|<TG>)+D?V{2,4}L");
  EXPECT_TRUE(tree.has_marks());
}

TEST(Oracle, KnowsThePaperCaustics) {
  // C [SD]* D S+ D? L (Doidge et al. 2012).
  const Tree tree = Tree::sequence(
      {letter("C"), Tree::repeat(Tree::choice({letter("S"), letter("D")}), 0, -1), letter("D"),
       Tree::repeat(letter("S"), 1, -1), Tree::repeat(letter("D"), 0, 1), letter("L")});
  const OracleRoutes routes({{"caustic", tree, estimator_named("photons")}}, {}, {});
  OracleRoutes set = routes;
  const auto owned = [&](const char* word) {
    bool all = true, none = true;
    for (const Path& path : set.paths_of(word)) (set.facts(path).owner ? none : all) = false;
    EXPECT_NE(all, none) << word;
    return all;
  };
  for (const char* word : {"C D S O", "C S S D S S B", "C D S D O", "C D D S O"})
    EXPECT_TRUE(owned(word)) << word;
  for (const char* word : {"C O", "C D O", "C S S O", "C D S D D O", "C V D S O", "C D S M"})
    EXPECT_FALSE(owned(word)) << word;
}

class OracleSeeds : public ::testing::TestWithParam<uint32_t> {};

TEST_P(OracleSeeds, MatchersAgree) {
  const bool with_label = GetParam() % 2 == 1;
  RandomRoutes random(GetParam(),
                      with_label ? std::vector<std::string>{"glass"} : std::vector<std::string>{});
  const Alphabet alphabet(with_label ? 1 : 0);
  const std::vector<Word> all = words_over(alphabet, with_label ? 2 : 3);
  size_t compared = 0, accepted_words = 0;
  for (int n = 0; n < 20; ++n) {
    const Tree tree = random.expression(n % 3 == 0);
    const Atom::Marks marks = tree.has_marks() ? Atom::Marks::kObey : Atom::Marks::kIgnore;
    Machine machine(tree, alphabet, marks);
    const std::regex regex(ecmascript(tree, alphabet, marks));
    for (const Word& word : all) {
      const bool accepted = machine.accepts(word);
      ++compared;
      accepted_words += accepted ? 1 : 0;
      ASSERT_EQ(accepted, matches_by_cutting(tree, alphabet, word, marks)) << tree.text();
      std::string characters;
      for (const Letter l : word) characters += character_of(l);
      ASSERT_EQ(accepted, std::regex_match(characters, regex)) << tree.text() << "\n" << characters;
    }
    // Longer words, some long enough for nested {n,m}.
    for (int k = 0; k < 300; ++k) {
      Word word{alphabet.eye()};
      for (int i = random.below(12); i > 0; --i)
        word.push_back(alphabet.event(random.below(alphabet.events())));
      word.push_back(alphabet.light(random.below(alphabet.lights())));
      ASSERT_EQ(machine.accepts(word), matches_by_cutting(tree, alphabet, word, marks))
          << tree.text();
    }
  }
  EXPECT_GT(compared, 40000u);
  EXPECT_GT(accepted_words, compared / 100);
}

INSTANTIATE_TEST_SUITE_P(Random, OracleSeeds, ::testing::Range(1u, 17u));

TEST(Oracle, KnowsExpressionsWithoutPaths) {
  const Alphabet alphabet(0);
  const auto possible = [&](const Tree& tree) {
    return Machine(tree, alphabet, Atom::Marks::kIgnore).matches_any_path();
  };
  EXPECT_TRUE(possible(Tree::repeat(letter("."), 0, -1)));
  EXPECT_TRUE(possible(Tree::sequence({letter("C"), letter("L")})));
  EXPECT_FALSE(possible(Tree::sequence({letter("C"), letter("D")})));
  EXPECT_FALSE(possible(Tree::sequence({letter("D"), letter("L")})));
  EXPECT_FALSE(possible(Tree::sequence({letter("C"), letter("L"), letter("D"), letter("L")})));
}

}  // namespace
}  // namespace nephroid::oracle
