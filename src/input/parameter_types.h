// A table of pbrt-v4's parameter types: their spellings, kinds of values and numbers per item. It
// must not know single parameters such as "radius".
#pragma once

#include <string>
#include <string_view>

namespace nephroid {

struct ParameterType {
  enum class Values { kNumbers, kIntegers, kStrings, kBools, kSpectrum };
  const char* spelling;  ///< spelling in a file
  const char* name;      ///< Parameter::type
  Values values;
  int numbers_per_item;  ///< 1 if the values are not numbers
};

/// The type with that spelling, or nullptr.
const ParameterType* find_parameter_type(std::string_view spelling);

/// All names of types, separated by commas, for messages.
std::string list_of_parameter_types();

}  // namespace nephroid
