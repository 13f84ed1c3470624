// Writes docs/scene-support.md, the support of every name of the scene format, from the tables of
// the loader. It must not know any name of the format.
#pragma once

#include <string>
#include <vector>

#include "input/format_rows.h"

namespace nephroid {

/// The types of one directive.
struct FormatKind {
  const char* heading;
  const char* directive;
  const char* about;  ///< sentences for the page
  std::vector<FormatType> types;
};

/// All directives that have types, in the order of the page.
std::vector<FormatKind> format_kinds();

/// The page.
std::string scene_support_markdown();

}  // namespace nephroid
