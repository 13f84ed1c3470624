// Parses a text and extracts the messages of its errors and warnings.
#pragma once

#include <string>

#include "input/pbrt_parser.h"

namespace nephroid::testing {

/// Parses `text` as a file "t.pbrt" and drops its warnings.
inline SceneDescription parse(const std::string& text) {
  Diagnostics diagnostics;
  return parse_pbrt_string(text, "t.pbrt", ".", diagnostics);
}

/// The message of the error that `action` throws, or "no error".
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

inline std::string parse_error(const std::string& text) {
  return error_of([&] { parse(text); });
}

/// All warnings of `text`, each with its location and on its own line.
inline std::string parse_warnings(const std::string& text) {
  Diagnostics diagnostics;
  parse_pbrt_string(text, "t.pbrt", ".", diagnostics);
  std::string all;
  for (const Warning& warning : diagnostics.warnings())
    all += located(warning.where, warning.message) + "\n";
  return all;
}

}  // namespace nephroid::testing
