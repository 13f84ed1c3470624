// The parameter types of pbrt-v4 scene files: their spellings, what their values are and how many
// numbers make one item. One table, read by the parameter reader and by the getters.
// Knows nothing of single parameters such as "radius".
#pragma once

#include <string>
#include <string_view>

namespace nephroid {

struct ParameterType {
  enum class Values { kNumbers, kIntegers, kStrings, kBools, kSpectrum };
  const char* spelling;  ///< as a file may write it
  const char* name;      ///< what a Parameter calls it
  Values values;
  int numbers_per_item;  ///< also for one of several items; 1 for what is not numbers
};

/// The type with that spelling, or nullptr.
const ParameterType* find_parameter_type(std::string_view spelling);

/// All names of types, separated by commas, for messages.
std::string list_of_parameter_types();

}  // namespace nephroid
