// Partial MIS weights of an eye path, with and without merges that need a caster, against the
// recursion of one side. path_weights_test.cpp compares that with brute force.
#include "integrator/bidirectional/eye_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <tuple>

namespace nephroid {
namespace {

constexpr LineFactors kLine{0.7, 1.3};
constexpr EventDensity kEvent{0.4, 0.9, true};

TEST(EyePartialWeights, AreThoseOfOneSideWhereAllMerges) {
  std::mt19937 engine(5);
  const auto number = [&] {
    return std::exp(std::ldexp(6.0 * static_cast<double>(engine()), -32) - 3);
  };
  for (const bool connects : {true, false}) {
    EyePartialWeights eye(connects, CasterRule());
    PartialMisWeights side{connects ? 0.3 : 0.0, 0};
    eye.arrive_first(side.here);
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(eye.most().here, side.here);
      EXPECT_EQ(eye.most().before, side.before);
      EXPECT_EQ(eye.asks_back(), side.before > 0);
      EXPECT_EQ(&eye.at_cut(EventClass::kDiffuse, Caster::kNone), &eye.most());
      EXPECT_TRUE(eye.merges(EventClass::kGlossy, Caster::kNone));
      const SideEnd end{side, {number(), number(), true}, number()};
      eye.leave(end.event, end.merge, EventClass::kGlossy);
      const LineFactors line{number(), number()};
      EXPECT_EQ(eye.end_to_light().next(line).before, end.next(line).before);
      eye.arrive(line);
      side = end.next(line);
      if (!connects) side.here = 0;
    }
  }
}

// The rule: a merge at a D needs a caster behind it, one at a G needs an S. Casters are S alone, or
// G as well. If any event is a caster, a merge at a D or a G needs some event behind it.
class Casters : public ::testing::TestWithParam<std::tuple<ClassMask, std::string>> {};
INSTANTIATE_TEST_SUITE_P(
    EyePartialWeights, Casters,
    ::testing::Combine(::testing::Values(ClassMask::kSpecular,
                                         ClassMask::kSpecular | ClassMask::kGlossy,
                                         ClassMask::kAll),
                       ::testing::Values("DD", "DS", "DG", "GS", "GG", "DGD", "DSD", "GSGD",
                                         "DDGSGD", "GDSDG", "DVGGDSD")));

TEST_P(Casters, LetVerticesBeforeThemMerge) {
  const ClassMask casters = std::get<0>(GetParam());
  const bool is_any = casters == ClassMask::kAll;
  const bool with_glossy = !is_any && contains(casters, EventClass::kGlossy);
  const std::string letters = std::get<1>(GetParam());
  const auto class_of = [](char c) {
    return static_cast<EventClass>(std::string_view("DGSV").find(c));
  };
  EyePartialWeights eye(false, CasterRule(casters));
  eye.arrive_first(0);
  // The rest of the path after the last vertex: only the light, a G, or an S.
  const std::string behind[] = {"", "G", "S"};
  const auto merges = [&](size_t i, const std::string& word) {
    const bool is_rough = word[i] == 'D' || word[i] == 'G';
    if (is_any) return is_rough && i + 1 < word.size();
    const bool s = word.find('S', i + 1) != std::string::npos;
    const bool g = with_glossy && word.find('G', i + 1) != std::string::npos;
    return word[i] == 'D' ? s || g : word[i] == 'G' && s;
  };
  for (size_t n = 0; n < letters.size(); ++n) {
    const std::string word = letters.substr(0, n + 1);
    const bool is_delta = letters[n] == 'S';
    for (size_t b = 0; b < kCasters; ++b) {
      if (b == 1 && !with_glossy) continue;
      const std::string whole = word + behind[b];
      PartialMisWeights side;
      for (size_t i = 0; i < n; ++i) {
        const EventDensity event = letters[i] == 'S' ? EventDensity{} : kEvent;
        side = SideEnd{side, event, merges(i, whole) ? 2.5 : 0}.next(kLine);
        side.here = 0;
      }
      const auto caster = static_cast<Caster>(b);
      EXPECT_EQ(eye.at_cut(class_of(letters[n]), caster).before, side.before) << whole;
      EXPECT_EQ(eye.merges(class_of(letters[n]), caster), merges(n, whole)) << whole;
    }
    eye.leave(is_delta ? EventDensity{} : kEvent, 2.5, class_of(letters[n]));
    EXPECT_EQ(eye.end_to_light().next(kLine).before > 0, [&] {
      for (size_t i = 0; i <= n; ++i)
        if (merges(i, word)) return true;
      return false;
    }()) << word;
    eye.arrive(kLine);
  }
}

TEST(EyePartialWeights, SayWhetherThereIsAnythingBefore) {
  for (const double here : {0.0, 0.5})
    for (const double before : {0.0, 0.5})
      for (const double merge : {0.0, 0.5})
        for (const bool finite : {true, false}) {
          const SideEnd end{{here, before}, finite ? kEvent : EventDensity{}, finite ? merge : 0};
          EXPECT_EQ(end.has_cuts_before(), end.next(kLine).before > 0);
        }
}

TEST(EyePartialWeights, TakeTheWayUnderASurfaceAsOneStep) {
  EyePartialWeights eye(false, CasterRule(ClassMask::kSpecular));
  eye.arrive_first(0.25);
  eye.leave(kEvent, 2.5, EventClass::kDiffuse);
  eye.arrive(kLine);
  const PartialMisWeights at_entry = eye.most();
  eye.come_out(3);
  EXPECT_EQ(eye.most().here, at_entry.here + heuristic(3) * at_entry.before);
  EXPECT_EQ(eye.most().before, 0);
}

}  // namespace
}  // namespace nephroid
