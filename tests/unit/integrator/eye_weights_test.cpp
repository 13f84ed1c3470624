// The sums of an eye path with and without merges that only a caster makes possible, against the
// recursion of one side (path_weights_test.cpp compares that with brute force).
#include "integrator/bidirectional/eye_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
    EyePartialWeights eye(connects, ClassMask::kNone);
    PartialMisWeights side{connects ? 0.3 : 0.0, 0};
    eye.arrive_first(side.here);
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(eye.all().here, side.here);
      EXPECT_EQ(eye.all().before, side.before);
      EXPECT_EQ(eye.asks_back(), side.before > 0);
      for (const bool before_light : {true, false})
        EXPECT_EQ(&eye.behind(EventClass::kDiffuse, before_light), &eye.all());
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

// Casters are S alone, or G as well, which is finite and has a merge of its own.
class Casters : public testing::TestWithParam<EventClass> {
 protected:
  const EventClass caster = GetParam();
  const bool is_glossy = caster == EventClass::kGlossy;
  EyePartialWeights eye{false, ClassMask::kSpecular | mask_of(caster)};
};
INSTANTIATE_TEST_SUITE_P(EyePartialWeights, Casters,
                         testing::Values(EventClass::kSpecular, EventClass::kGlossy));

TEST_P(Casters, LetVerticesBeforeThemMerge) {
  eye.arrive_first(0);
  EXPECT_FALSE(eye.merges_here(true));
  EXPECT_TRUE(eye.merges_here(false)) << "what follows on the light's side may be a caster";
  // D, D: no merge could have found a light here, but one at either would if a caster came.
  for (int i = 0; i < 2; ++i) {
    eye.leave(kEvent, 2.5, EventClass::kDiffuse);
    EXPECT_FALSE(eye.end_to_light().has_cuts_before());
    eye.arrive(kLine);
    EXPECT_TRUE(eye.asks_back());
    for (const EventClass c : {EventClass::kDiffuse, EventClass::kVolume})
      EXPECT_TRUE(eye.behind(c, true).empty());
    EXPECT_EQ(eye.behind(EventClass::kGlossy, true).empty(), !is_glossy);
    EXPECT_GT(eye.behind(caster, true).before, 0);
    EXPECT_GT(eye.behind(EventClass::kDiffuse, false).before, 0);
  }
  // The caster: the vertices before it merge now, its own only if another one follows.
  const PartialMisWeights at_caster = eye.all();
  const EventDensity event = is_glossy ? kEvent : EventDensity{};
  const double merge = is_glossy ? 2.5 : 0;
  eye.leave(event, merge, caster);
  EXPECT_TRUE(eye.end_to_light().has_cuts_before());
  eye.arrive(kLine);
  EXPECT_EQ(eye.all().before, (SideEnd{at_caster, event, merge}.next(kLine).before));
  EXPECT_EQ(eye.behind(EventClass::kDiffuse, true).before,
            (SideEnd{at_caster, event, 0}.next(kLine).before));
  // A D behind it merges for itself only if another caster comes.
  eye.leave(kEvent, 2.5, EventClass::kDiffuse);
  eye.arrive(kLine);
  EXPECT_GT(eye.all().before, eye.behind(EventClass::kDiffuse, true).before);
  EXPECT_GT(eye.behind(EventClass::kDiffuse, true).before, 0);
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
  EyePartialWeights eye(true, ClassMask::kSpecular);
  eye.arrive_first(0.25);
  eye.leave(kEvent, 2.5, EventClass::kDiffuse);
  eye.arrive(kLine);
  const PartialMisWeights at_entry = eye.all();
  eye.come_out(3);
  EXPECT_EQ(eye.all().here, at_entry.here + heuristic(3) * at_entry.before);
  EXPECT_EQ(eye.all().before, 0);
}

}  // namespace
}  // namespace nephroid
