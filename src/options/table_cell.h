// Cells of the tables in generated pages.
#pragma once

#include <string>

namespace nephroid {

/// The text of a table cell, with bars escaped: they would end the cell.
inline std::string table_cell(std::string text) {
  for (size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, "\\");
  return text;
}

}  // namespace nephroid
