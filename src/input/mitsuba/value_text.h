// Values in attributes of Mitsuba's XML. It must not know properties.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"

namespace nephroid::mitsuba {

/// "int_ior" for "intIOR": the style of Mitsuba 3, in which all names are compared.
std::string snake_case(std::string_view name);

/// The text without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The words between blanks, commas and semicolons.
std::vector<std::string_view> words_of(std::string_view text);

/// One finite number. `what` names it in the error.
double finite_number(std::string_view text, const std::string& what, const SourceLocation& where);

/// Finite numbers between blanks and commas.
std::vector<double> finite_numbers(std::string_view text, const std::string& what,
                                   const SourceLocation& where);

}  // namespace nephroid::mitsuba
