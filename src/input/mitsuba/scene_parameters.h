// The parameters of a Mitsuba scene: $name stands for a value of <default> or of the user. It must
// not know XML.
#pragma once

#include <map>
#include <set>
#include <string>

#include "core/errors.h"

namespace nephroid::mitsuba {

class SceneParameters {
 public:
  /// `defines` are the user's values; they win over defaults.
  explicit SceneParameters(std::map<std::string, std::string> defines);

  /// A default counts where nothing else gave a value before.
  void set_default(const std::string& name, const std::string& value);
  /// The text with the values of its parameters. Throws SceneError if one is unknown, and if the
  /// values that were put into all texts so far are too long together.
  std::string replaced(const std::string& text, const SourceLocation& where) const;
  /// The values of the parameters that the scene has.
  std::map<std::string, std::string> values() const;
  /// Warns of values of the user that the scene does not know.
  void report_unused(const SourceLocation& scene, Diagnostics& diagnostics) const;

 private:
  std::map<std::string, std::string> values_;
  std::set<std::string> defined_by_user_;
  mutable std::set<std::string> used_;
  mutable size_t replaced_ = 0;  ///< characters of values in all texts
};

}  // namespace nephroid::mitsuba
