// The table of MTL's keywords. It must not know how lines are read.
#pragma once

#include <string>

#include "input/format_rows.h"

namespace nephroid {

struct MtlKeyword {
  enum class Values { kColor, kNumber, kMap, kNone };
  Values values = Values::kNone;  ///< kNone: ignored
  const char* canonical = "";     ///< the name of which it is another spelling
};

/// The keyword, compared without case; nullptr if the format has none.
const MtlKeyword* find_mtl_keyword(const std::string& keyword);

/// The same keywords for docs/obj-support.md.
FormatParameters mtl_keywords();

}  // namespace nephroid
