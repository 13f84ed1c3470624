// Short ways to parse a text and to get at the message of the error that it causes.
// Used by the tests of this folder only.
#pragma once

#include <string>

#include "input/pbrt_parser.h"

namespace nephroid::testing {

/// Parses `text` as a file "t.pbrt" and drops its warnings.
inline SceneDescription parse(const std::string& text) {
  Diagnostics diagnostics;
  return parse_pbrt_string(text, "t.pbrt", ".", diagnostics);
}

/// What the error says that `action` causes, or "no error".
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

/// All warnings of `text`, each with its place and on its own line.
inline std::string parse_warnings(const std::string& text) {
  Diagnostics diagnostics;
  parse_pbrt_string(text, "t.pbrt", ".", diagnostics);
  std::string all;
  for (const Warning& warning : diagnostics.warnings())
    all += located(warning.where, warning.message) + "\n";
  return all;
}

}  // namespace nephroid::testing
