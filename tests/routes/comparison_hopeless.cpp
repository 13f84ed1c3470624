// Upper bound of the useful events: no event that leads nowhere is called useful. comparison.cpp
// checks the lower bound, that every path can be sampled; see comparison.h.
#include <algorithm>

#include "routes/comparison.h"

namespace nephroid::oracle {

void Comparison::nothing_hopeless() {
  path_ = {};
  const RouteTables& tables = routes_.tables();
  const size_t eyes = tables.eye_states, ends = tables.light_states;
  // States that some path reaches.
  std::vector<bool> eye_reached(eyes), light_reached(ends);
  std::vector<EyeState> eye_queue{routes_.start()};
  std::vector<LightState> light_queue;
  eye_reached[routes_.start()] = true;
  for (size_t i = 0; i < eye_queue.size(); ++i)
    for (const EventSymbol e : events_)
      if (const EyeState s = routes_.next(eye_queue[i], e); !eye_reached[s])
        eye_reached[s] = true, eye_queue.push_back(s);
  for (const LightSymbol l : lights_)
    if (const LightState s = routes_.emitted(l); !light_reached[s])
      light_reached[s] = true, light_queue.push_back(s);
  for (size_t i = 0; i < light_queue.size(); ++i)
    for (const EventSymbol e : events_)
      if (const LightState s = routes_.light_next(light_queue[i], e); !light_reached[s])
        light_reached[s] = true, light_queue.push_back(s);

  for (size_t g = 0; g < routes_.groups().size(); ++g) {
    // Events that can still lead to a path of the group, by fixed-point iteration.
    const auto closure = [&](size_t states, const auto& next, const auto& good) {
      std::vector<bool> alive(states);
      for (size_t s = 0; s < states; ++s) alive[s] = good(s);
      for (bool changed = true; changed;) {
        changed = false;
        for (size_t s = 0; s < states; ++s)
          for (const EventSymbol e : events_)
            if (!alive[s] && alive[next(s, e)]) changed = alive[s] = true;
      }
      return alive;
    };
    const auto hopeless = [&](ClassMask mask, Label label, const auto& leads) {
      for (const EventClass c : {EventClass::kDiffuse, EventClass::kGlossy, EventClass::kSpecular,
                                 EventClass::kVolume, EventClass::kHair}) {
        bool any = !contains(mask, c);
        for (const EventSymbol e : events_)
          any = any || (label_of(e) == label && class_of(kind_of(e)) == c && leads(e));
        if (!any) return true;
      }
      return false;
    };
    const auto eye_next = [&](size_t s, EventSymbol e) { return routes_.next(EyeState(s), e); };
    const auto light_next = [&](size_t s, EventSymbol e) {
      return routes_.light_next(LightState(s), e);
    };
    const auto merged = [&](EyeState s, EventSymbol e, LightState l) {
      return routes_.owns(g, routes_.meet(routes_.merge(s, e), l));
    };
    const auto merges = [&](EyeState s, EventSymbol e) {
      return std::any_of(light_queue.begin(), light_queue.end(),
                         [&](LightState l) { return merged(s, e, l); });
    };
    const auto deposits = [&](LightState l, EventSymbol e) {
      return std::any_of(eye_queue.begin(), eye_queue.end(),
                         [&](EyeState s) { return merged(s, e, l); });
    };
    const auto connects = [&](LightState l, EventSymbol e) {
      return routes_.owns(g, routes_.meet(routes_.next(routes_.start(), e), l));
    };
    const auto with_any = [&](const auto& test) {
      return [&, test](size_t s) {
        return std::any_of(events_.begin(), events_.end(),
                           [&](EventSymbol e) { return test(static_cast<uint16_t>(s), e); });
      };
    };
    const auto ends_here = [&](size_t s) {
      return std::any_of(lights_.begin(), lights_.end(), [&](LightSymbol l) {
        return routes_.owns(g, routes_.owner(EyeState(s), l));
      });
    };
    const EstimatorTraits* const estimator = routes_.groups()[g].estimator;
    const std::vector<bool> ending = closure(eyes, eye_next, ends_here);
    std::vector<bool> merging, depositing, connecting;
    if (estimator->merges) {
      merging = closure(eyes, eye_next, with_any(merges));
      depositing = closure(ends, light_next, with_any(deposits));
    }
    if (connects_lights(estimator)) connecting = closure(ends, light_next, with_any(connects));

    for (Label label = 0; label <= routes_.labels().size(); ++label) {
      for (const EyeState s : eye_queue) {
        const auto to = [&](const std::vector<bool>& states) {
          return [&](EventSymbol e) { return bool(states[routes_.next(s, e)]); };
        };
        if (walks_from_eye(estimator)) {
          if (routes_.ends(g, s) && !ends_here(s)) fail("a walk may end where no path does");
          if (hopeless(routes_.useful(g, s, label), label, to(ending)))
            fail("a hopeless event is useful");
        }
        if (merging.empty()) continue;
        if (hopeless(routes_.useful_before_merge(g, s, label), label, to(merging)))
          fail("a hopeless event is useful before merging");
        if (hopeless(routes_.merges(g, s, label), label,
                     [&](EventSymbol e) { return merges(s, e); }))
          fail("photons are merged where none can be");
      }
      for (const LightState l : light_queue) {
        const auto to = [&](const std::vector<bool>& states) {
          return [&](EventSymbol e) { return bool(states[routes_.light_next(l, e)]); };
        };
        const auto meets = [&](EventSymbol e) {
          return std::any_of(eye_queue.begin(), eye_queue.end(), [&](EyeState s) {
            return routes_.owns(g, routes_.meet(s, routes_.light_next(l, e)));
          });
        };
        if (hopeless(routes_.useful_from_light(g, l, label), label, meets))
          fail("light walks go where no eye's walk can meet them");
        if (!depositing.empty() &&
            (hopeless(routes_.useful_before_deposit(g, l, label), label, to(depositing)) ||
             hopeless(routes_.deposits(g, l, label), label,
                      [&](EventSymbol e) { return deposits(l, e); })))
          fail("photons go where none is merged");
        if (!connecting.empty() &&
            (hopeless(routes_.useful_before_connection(g, l, label), label, to(connecting)) ||
             hopeless(routes_.connects(g, l, label), label,
                      [&](EventSymbol e) { return connects(l, e); })))
          fail("light walks go where none is connected");
      }
    }
  }
}

}  // namespace nephroid::oracle
