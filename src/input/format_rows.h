// Table rows of the scene format: one per type (of shapes, materials ...) and per parameter. The
// tables of makers carry them, so that makers, warnings and docs/scene-support.md cannot disagree.
// It must not know any type.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// The treatment of a type or a parameter of the format.
enum class Support {
  kRendered,
  kNotNeeded,  ///< accepted without a warning: the picture does not depend on it
  kWarned,     ///< ignored with a warning
  kRefused,    ///< a located error
};

/// A parameter as in docs/scene-support.md. The makers check types and have the defaults.
struct FormatParameter {
  const char* type;  ///< "float", "spectrum or texture" ...
  const char* name;
  const char* fallback = "";  ///< the default, in words
  const char* unit = "";
  const char* note = "";  ///< a phrase; the reason if it is ignored
  Support support = Support::kRendered;
};

using FormatParameters = std::span<const FormatParameter>;

/// A type with its lists of parameters, its own and shared ones.
struct FormatType {
  const char* name;
  std::array<FormatParameters, 5> parameters;
  const char* note = "";
  Support support = Support::kRendered;

  /// The parameter of that name; nullptr if the format has none.
  const FormatParameter* find(const std::string& parameter) const;
};

/// `"a", "b", "c"`: the names that could be written instead, without refused and empty ones.
std::string quoted_names(std::span<const FormatType> types);

/// Throws SceneError at `where`: the type `name` of this `kind` is unknown or refused.
[[noreturn]] void refuse_type(const std::string& kind, const std::string& name,
                              std::span<const FormatType> types, const SourceLocation& where);

/// The FormatType parts of a table's rows.
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

/// The row of `name`. Throws SceneError at `where` if there is none or it is refused.
template <class Row, size_t N>
const Row& row_of(const Row (&table)[N], const std::string& kind, const std::string& name,
                  const SourceLocation& where) {
  const Row* row = find_row(table, name);
  if (!row || row->support == Support::kRefused)
    refuse_type(kind, name, format_types(table), where);
  return *row;
}

}  // namespace nephroid
