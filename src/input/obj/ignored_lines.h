// Lines of OBJ and MTL files that are not rendered, with the reason. One warning per keyword, since
// such lines come in thousands.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/errors.h"
#include "input/format_rows.h"

namespace nephroid {

class IgnoredLines {
 public:
  /// `rows` are the keywords of the format; the note of one that is ignored is the reason.
  IgnoredLines(std::shared_ptr<const std::string> file, FormatParameters rows,
               Diagnostics& diagnostics);

  /// Counts a line that begins with this keyword.
  void add(const std::string& keyword, int line);
  /// Warns of each counted keyword at its first line.
  void report() const;

 private:
  struct Lines {
    int first = 0, count = 0;
  };
  std::shared_ptr<const std::string> file_;
  FormatParameters rows_;
  Diagnostics& diagnostics_;
  std::map<std::string, Lines> lines_;
};

/// The rows of OBJ's keywords, for docs/obj-support.md.
FormatParameters obj_keywords();

}  // namespace nephroid
