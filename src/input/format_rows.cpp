#include "input/format_rows.h"

#include "input/spelling.h"

namespace nephroid {

const FormatParameter* FormatType::find(const std::string& parameter) const {
  for (const FormatParameters& list : parameters)
    for (const FormatParameter& p : list)
      if (parameter == p.name) return &p;
  return nullptr;
}

std::string quoted_names(std::span<const FormatType> types) {
  std::string names;
  for (const FormatType& type : types)
    if (type.support != Support::kRefused && *type.name)
      names += (names.empty() ? "\"" : ", \"") + std::string(type.name) + "\"";
  return names;
}

void refuse_type(const std::string& kind, const std::string& name,
                 std::span<const FormatType> types, const SourceLocation& where) {
  const std::string expected = ", expected one of " + quoted_names(types);
  std::vector<std::string> known;
  for (const FormatType& type : types) {
    if (name == type.name)
      throw SceneError(where, kind + " \"" + name + "\" is not rendered: " + type.note + expected);
    known.emplace_back(type.name);
  }
  const std::string meant = did_you_mean(name, known, kind);
  throw SceneError(where,
                   "unknown " + kind + " \"" + name + "\"" + (meant.empty() ? expected : meant));
}

}  // namespace nephroid
