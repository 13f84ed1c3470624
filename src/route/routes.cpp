// The tables of compiled routes and the groups of routes by estimator. It must not know
// expressions.
#include "route/routes.h"

#include <algorithm>
#include <utility>

namespace nephroid {

NumberTable::NumberTable(const std::vector<uint16_t>& numbers) {
  const bool fits =
      std::all_of(numbers.begin(), numbers.end(), [](uint16_t n) { return n <= 255; });
  if (!fits) {
    wide_ = numbers;
    return;
  }
  for (const uint16_t n : numbers) narrow_.push_back(static_cast<uint8_t>(n));
}

Routes::Routes(std::vector<RouteDefinition> routes, std::vector<AovDefinition> aovs,
               std::vector<PartMeaning> parts, std::vector<std::string> labels, RouteTables tables)
    : definitions_(std::move(routes)),
      aovs_(std::move(aovs)),
      parts_(std::move(parts)),
      labels_(std::move(labels)),
      tables_(std::move(tables)) {
  std::vector<size_t> group_of;  // [route]
  for (size_t r = 0; r < definitions_.size(); ++r) {
    const EstimatorTraits* estimator = definitions_[r].estimator;
    auto group = std::find_if(groups_.begin(), groups_.end(), [&](const RouteGroup& g) {
      return g.estimator == estimator && !estimator->one_route_each;
    });
    if (group == groups_.end()) group = groups_.insert(groups_.end(), {estimator, {}, {}});
    group->routes.push_back(static_cast<int>(r));
    group_of.push_back(group - groups_.begin());
  }
  for (size_t p = 0; p < parts_.size(); ++p) {
    const size_t g = group_of[parts_[p].route];
    groups_[g].parts.push_back(static_cast<Part>(p));
    part_group_.push_back(static_cast<uint8_t>(g));
  }
  find_useful_events({std::vector<bool>(tables_.event_symbols, true),
                      std::vector<bool>(tables_.light_symbols, true)});
}

Label Routes::label(const std::string& name) const {
  const auto found = std::find(labels_.begin(), labels_.end(), name);
  return found == labels_.end() ? Label{0} : static_cast<Label>(found - labels_.begin() + 1);
}

Routes Routes::restricted_to(const SymbolSet& symbols) const {
  Routes restricted = *this;
  restricted.find_useful_events(symbols);
  return restricted;
}

}  // namespace nephroid
