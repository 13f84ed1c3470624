#include "core/errors.h"

namespace nephroid {

std::string SourceLocation::to_string() const {
  std::string text = file ? *file : std::string();
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  return text;
}

std::string located(const SourceLocation& where, const std::string& message) {
  const std::string place = where.to_string();
  return place.empty() ? message : place + ": " + message;
}

SceneError::SceneError(SourceLocation where, const std::string& message)
    : Error(ExitStatus::kScene, located(where, message)), where_(std::move(where)) {}

void Diagnostics::warn(SourceLocation where, std::string message) {
  add({std::move(where), std::move(message), false});
}

void Diagnostics::warn_of_unknown_name(SourceLocation where, std::string message) {
  add({std::move(where), std::move(message), true});
}

void Diagnostics::add(Warning warning) {
  const std::lock_guard lock(mutex_);
  if (known_.insert(located(warning.where, warning.message)).second)
    warnings_.push_back(std::move(warning));
}

std::vector<Warning> Diagnostics::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

}  // namespace nephroid
