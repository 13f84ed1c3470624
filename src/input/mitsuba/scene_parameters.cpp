#include "input/mitsuba/scene_parameters.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "input/spelling.h"

namespace nephroid::mitsuba {
namespace {

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

}  // namespace

SceneParameters::SceneParameters(std::map<std::string, std::string> defines)
    : values_(std::move(defines)) {
  for (const auto& entry : values_) defined_by_user_.insert(entry.first);
}

void SceneParameters::set_default(const std::string& name, const std::string& value) {
  values_.try_emplace(name, value);
  used_.insert(name);
}

std::string SceneParameters::replaced(const std::string& text, const SourceLocation& where) const {
  constexpr size_t kMaxLength = 1 << 20, kMaxReplaced = 1 << 24;
  std::string result;
  for (size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      result += text[i++];
      continue;
    }
    const auto begin = text.begin() + static_cast<ptrdiff_t>(i) + 1;
    const std::string name(begin, std::find_if_not(begin, text.end(), is_name_character));
    const auto value = values_.find(name);
    if (value == values_.end()) {
      std::vector<std::string> known;
      for (const auto& entry : values_) known.push_back(entry.first);
      throw SceneError(where, "parameter \"$" + name +
                                  "\" has no value, expected a <default> or one by --define" +
                                  did_you_mean(name, known));
    }
    used_.insert(name);
    result += value->second;
    replaced_ += value->second.size();
    if (replaced_ > kMaxReplaced)
      throw SceneError(where,
                       "the values of parameters fill more than 2^24 characters of the scene, "
                       "expected fewer");
    if (result.size() > kMaxLength)
      throw SceneError(where,
                       "the text with its parameters has more than 2^20 characters, "
                       "expected fewer");
    i += name.size() + 1;
  }
  return result;
}

std::map<std::string, std::string> SceneParameters::values() const {
  std::map<std::string, std::string> values;
  for (const std::string& name : used_) values[name] = values_.at(name);
  return values;
}

void SceneParameters::report_unused(const SourceLocation& scene, Diagnostics& diagnostics) const {
  for (const std::string& name : defined_by_user_)
    if (!used_.contains(name))
      diagnostics.warn(scene, "the scene has no parameter \"$" + name + "\", its value is ignored");
}

}  // namespace nephroid::mitsuba
