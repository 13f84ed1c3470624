#include "route/path_summary.h"

#include <algorithm>

namespace nephroid {
namespace {

FirstRoughPair after(FirstRoughPair pair, bool is_surface) {
  if (pair == FirstRoughPair::kBoth || pair == FirstRoughPair::kNever) return pair;
  if (pair == FirstRoughPair::kFirst)
    return is_surface ? FirstRoughPair::kBoth : FirstRoughPair::kNever;
  return is_surface ? FirstRoughPair::kFirst : FirstRoughPair::kNone;
}

}  // namespace

EventSummary EventSummary::after(EventClass event) const {
  const bool specular = event == EventClass::kSpecular;
  const bool is_surface = contains(ClassMask::kRough, event);
  EventSummary next = *this;
  next.count = std::min(count + 1, 2);
  next.any_rough |= !specular;
  next.volume_before_rough |= !any_rough && event == EventClass::kVolume;
  next.any_surface |= is_surface;
  next.any_volume |= event == EventClass::kVolume;
  if (count == 0) next.first_specular = specular;
  next.last_specular = specular;
  next.rough_pair |= count > 0 && !last_specular && !specular;
  next.first_pair = nephroid::after(first_pair, is_surface);
  return next;
}

}  // namespace nephroid
