// What is known of the names of the scene format: one row per type (of shapes, materials ...) and
// per parameter. The tables of makers carry these rows, so that makers, warnings about parameters
// and docs/scene-support.md cannot disagree. Who calls it: all tables of types, ParameterSet's
// warnings, the page. It must not know any type.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// What becomes of a type or a parameter that the format knows.
enum class Support {
  kRendered,
  kNotNeeded,  ///< the picture does not depend on it: taken without a word
  kWarned,     ///< ignored with a warning
  kRefused,    ///< a located error
};

/// A parameter as the page shows it. The makers check types and hold the defaults.
struct FormatParameter {
  const char* type;  ///< "float", "spectrum or texture" ...
  const char* name;
  const char* fallback = "";  ///< the default, in words
  const char* unit = "";
  const char* note = "";  ///< half a sentence; of ignored ones it says why
  Support support = Support::kRendered;
};

using FormatParameters = std::span<const FormatParameter>;

/// A type with the lists of parameters that it has, its own and those that it shares with others.
struct FormatType {
  const char* name;
  std::array<FormatParameters, 5> parameters;
  const char* note = "";
  Support support = Support::kRendered;

  /// The parameter of that name; nullptr if the format has none.
  const FormatParameter* find(const std::string& parameter) const;
};

/// `"a", "b", "c"`: what could be written instead. Without what is refused and the empty name.
std::string quoted_names(std::span<const FormatType> types);

/// Throws SceneError at `where`: there is no `kind` of type `name`, or it is one that is refused.
[[noreturn]] void refuse_type(const std::string& kind, const std::string& name,
                              std::span<const FormatType> types, const SourceLocation& where);

/// The rows of a table whose rows derive from FormatType.
template <class Row, size_t N>
std::vector<FormatType> format_types(const Row (&table)[N]) {
  return std::vector<FormatType>(std::begin(table), std::end(table));
}

/// The row of the table with that name; nullptr if there is none.
template <class Row, size_t N>
const Row* find_row(const Row (&table)[N], const std::string& name) {
  for (const Row& row : table)
    if (name == row.name) return &row;
  return nullptr;
}

/// The row that makes `name`; throws SceneError at `where` if there is none or it is refused.
template <class Row, size_t N>
const Row& row_of(const Row (&table)[N], const std::string& kind, const std::string& name,
                  const SourceLocation& where) {
  const Row* row = find_row(table, name);
  if (!row || row->support == Support::kRefused)
    refuse_type(kind, name, format_types(table), where);
  return *row;
}

}  // namespace nephroid
