// The typed getters of ParameterSet. They check type and count when called, so that the message has
// what was expected.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/counted.h"
#include "input/format_rows.h"
#include "input/spelling.h"

namespace nephroid {
namespace {

std::string title(const Parameter& parameter) {
  return "parameter \"" + parameter.name + "\"";
}

/// The parameter with that name, checked to be of that type; nullptr if absent.
const Parameter* find_typed(const ParameterSet& set, const std::string& name, const char* type) {
  const Parameter* parameter = set.find(name);
  if (parameter && parameter->type != type) {
    throw SceneError(parameter->where, title(*parameter) + " has type \"" + parameter->type +
                                           "\", expected \"" + type + "\"");
  }
  return parameter;
}

void expect_count(const Parameter& parameter, size_t found, size_t expected) {
  if (found == expected) return;
  throw SceneError(parameter.where, title(parameter) + " has " + counted(found, "value") +
                                        ", expected " + std::to_string(expected));
}

float to_float(const Parameter& parameter, double value) {
  if (!(std::abs(value) <= std::numeric_limits<float>::max()))
    throw SceneError(parameter.where, title(parameter) + " has a value that is not a finite float");
  return static_cast<float>(value);
}

int to_int(const Parameter& parameter, double value) {
  if (!(value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max() &&
        value == std::floor(value))) {
    throw SceneError(parameter.where,
                     title(parameter) + " has a value that is not a 32-bit integer");
  }
  return static_cast<int>(value);
}

template <class Vec>
Vec item_at(const Parameter& parameter, size_t first) {
  Vec item;
  for (unsigned int i = 0; i < Vec::dimensions(); ++i)
    item[static_cast<int>(i)] = to_float(parameter, parameter.numbers[first + i]);
  return item;
}

template <class Vec>
std::vector<Vec> get_items(const ParameterSet& set, const std::string& name, const char* type) {
  const Parameter* parameter = find_typed(set, name, type);
  if (!parameter) return {};
  const size_t size = Vec::dimensions();
  const size_t count = parameter->numbers.size();
  if (count % size != 0) {
    throw SceneError(parameter->where, title(*parameter) + " has " + counted(count, "number") +
                                           ", expected a multiple of " + std::to_string(size));
  }
  std::vector<Vec> items;
  items.reserve(count / size);
  for (size_t i = 0; i < count; i += size) items.push_back(item_at<Vec>(*parameter, i));
  return items;
}

std::optional<Vec3f> get_item(const ParameterSet& set, const std::string& name, const char* type) {
  const Parameter* parameter = find_typed(set, name, type);
  if (!parameter) return std::nullopt;
  if (parameter->numbers.size() != 3) {
    throw SceneError(parameter->where, title(*parameter) + " has " +
                                           counted(parameter->numbers.size(), "number") +
                                           ", expected 3");
  }
  return item_at<Vec3f>(*parameter, 0);
}

}  // namespace

const Parameter* ParameterSet::peek(const std::string& name) const {
  const auto found = std::ranges::find(list, name, &Parameter::name);
  return found == list.end() ? nullptr : &*found;
}

const Parameter* ParameterSet::find(const std::string& name) const {
  if (asked) asked->insert(name);
  const Parameter* parameter = peek(name);
  if (parameter) parameter->used = true;
  return parameter;
}

const Parameter* ParameterSet::find(const std::string& name,
                                    std::initializer_list<const char*> types) const {
  if (asked) asked->insert(name);
  for (const Parameter& parameter : list) {
    if (parameter.name != name || std::none_of(types.begin(), types.end(), [&](const char* type) {
          return parameter.type == type;
        }))
      continue;
    parameter.used = true;
    return &parameter;
  }
  return nullptr;
}

float ParameterSet::get_float(const std::string& name, float fallback) const {
  const Parameter* parameter = find_typed(*this, name, "float");
  if (!parameter) return fallback;
  expect_count(*parameter, parameter->numbers.size(), 1);
  return to_float(*parameter, parameter->numbers[0]);
}

int ParameterSet::get_int(const std::string& name, int fallback) const {
  const Parameter* parameter = find_typed(*this, name, "integer");
  if (!parameter) return fallback;
  expect_count(*parameter, parameter->numbers.size(), 1);
  return to_int(*parameter, parameter->numbers[0]);
}

bool ParameterSet::get_bool(const std::string& name, bool fallback) const {
  const Parameter* parameter = find_typed(*this, name, "bool");
  if (!parameter) return fallback;
  expect_count(*parameter, parameter->bools.size(), 1);
  return parameter->bools[0];
}

std::string ParameterSet::get_string(const std::string& name, const std::string& fallback) const {
  const Parameter* parameter = find_typed(*this, name, "string");
  if (!parameter) return fallback;
  expect_count(*parameter, parameter->strings.size(), 1);
  return parameter->strings[0];
}

std::optional<Vec3f> ParameterSet::get_point3(const std::string& name) const {
  return get_item(*this, name, "point3");
}

std::optional<Vec3f> ParameterSet::get_vector3(const std::string& name) const {
  return get_item(*this, name, "vector3");
}

std::vector<float> ParameterSet::get_floats(const std::string& name) const {
  const Parameter* parameter = find_typed(*this, name, "float");
  if (!parameter) return {};
  std::vector<float> values;
  values.reserve(parameter->numbers.size());
  for (const double value : parameter->numbers) values.push_back(to_float(*parameter, value));
  return values;
}

std::vector<int> ParameterSet::get_ints(const std::string& name) const {
  const Parameter* parameter = find_typed(*this, name, "integer");
  if (!parameter) return {};
  std::vector<int> values;
  values.reserve(parameter->numbers.size());
  for (const double value : parameter->numbers) values.push_back(to_int(*parameter, value));
  return values;
}

std::vector<Vec2f> ParameterSet::get_point2s(const std::string& name) const {
  return get_items<Vec2f>(*this, name, "point2");
}

std::vector<Vec3f> ParameterSet::get_point3s(const std::string& name) const {
  return get_items<Vec3f>(*this, name, "point3");
}

std::vector<Vec3f> ParameterSet::get_vector3s(const std::string& name) const {
  return get_items<Vec3f>(*this, name, "vector3");
}

std::vector<Vec3f> ParameterSet::get_normals(const std::string& name) const {
  return get_items<Vec3f>(*this, name, "normal");
}

void ParameterSet::report_unused(const std::string& of_what, const FormatType& type,
                                 Diagnostics& diagnostics) const {
  for (const Parameter& parameter : list) {
    const FormatParameter* known = type.find(parameter.name);
    if (parameter.used || (known && known->support == Support::kNotNeeded)) continue;
    const std::string named = title(parameter) + " of " + of_what;
    if (known) {
      diagnostics.warn(parameter.where,
                       named + (known->support == Support::kRendered
                                    ? " has no effect together with the other parameters"
                                    : std::string(" is ignored: ") + known->note));
      continue;
    }
    std::vector<std::string> names;
    for (const FormatParameters& some : type.parameters)
      for (const FormatParameter& p : some) names.emplace_back(p.name);
    const std::string meant = did_you_mean(parameter.name, names);
    diagnostics.warn_of_unknown_name(
        parameter.where, "unknown " + named + (meant.empty() ? std::string(", ignored") : meant));
  }
}

}  // namespace nephroid
