// f_l(s) is the part of the word that ends in eye state s with light l. With one more event e,
// f_{e w}(s) = f_w(next(s, e)). The vectors f are the light states.
#include "route/light_side.h"

#include <string>
#include <unordered_map>
#include <utility>

#include "core/errors.h"

namespace nephroid {
namespace {

constexpr size_t kMaxLightStates = 4096;
constexpr size_t kMaxBytes = size_t{64} << 20;

}  // namespace

LightSide reverse(const Automaton& a) {
  LightSide side;
  std::unordered_map<std::string, int> known;  // keys: the bytes of the vectors
  const auto number = [&](std::vector<Part> vector) {
    const auto [at, is_new] = known.try_emplace(std::string(vector.begin(), vector.end()),
                                                static_cast<int>(known.size()));
    if (is_new) {
      side.meet.push_back(std::move(vector));
      if (known.size() > kMaxLightStates || known.size() * a.states() > kMaxBytes)
        throw UsageError(
            "the routes are too complex: their automaton, read from the light, has more than " +
            std::to_string(known.size() - 1) +
            " states, expected expressions that distinguish fewer events near the eye");
    }
    return at->second;
  };
  for (int l = 0; l < static_cast<int>(a.lights); ++l) {
    std::vector<Part> ends;
    for (int s = 0; s < static_cast<int>(a.states()); ++s)
      ends.push_back(static_cast<Part>(a.at(s, l)));
    side.emitted.push_back(number(std::move(ends)));
  }
  for (size_t state = 0; state < side.meet.size(); ++state)
    for (int e = 0; e < static_cast<int>(a.events); ++e) {
      std::vector<Part> before(a.states());
      for (int s = 0; s < static_cast<int>(a.states()); ++s)
        before[s] = side.meet[state][a.after(s, e)];
      side.next.push_back(number(std::move(before)));
    }
  return side;
}

}  // namespace nephroid
