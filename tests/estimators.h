// Looks up estimators by name.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "integrator/presets/estimator_table.h"

namespace nephroid {

/// Throws if there is none of that name.
inline const EstimatorTraits* estimator_named(std::string_view name) {
  for (const EstimatorTraits* traits : estimator_traits())
    if (name == traits->name) return traits;
  throw std::invalid_argument("no estimator is called " + std::string(name));
}

inline bool is_one_of(const EstimatorTraits* estimator,
                      std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, std::string_view(estimator->name)) != names.end();
}

}  // namespace nephroid
