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
  add(warnings_, {std::move(where), std::move(message), false});
}

void Diagnostics::warn_of_unknown_name(SourceLocation where, std::string message) {
  add(warnings_, {std::move(where), std::move(message), true});
}

void Diagnostics::note(SourceLocation where, std::string message) {
  add(notes_, {std::move(where), std::move(message), false});
}

void Diagnostics::add(std::vector<Warning>& to, Warning warning) {
  const std::lock_guard lock(mutex_);
  if (known_.insert(located(warning.where, warning.message)).second)
    to.push_back(std::move(warning));
}

std::vector<Warning> Diagnostics::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

std::vector<Warning> Diagnostics::notes() const {
  const std::lock_guard lock(mutex_);
  return notes_;
}

}  // namespace nephroid
