// The lines and words of OBJ and MTL files: "\" joins a line with the next, "#" begins a comment.
// It must not know keywords, except those that name a material.
#pragma once

#include <string>
#include <string_view>

namespace nephroid {

struct TextLine {
  std::string_view text;  ///< valid until the next line is read; neither blank nor a comment
  int number = 0;         ///< line in the file, counted from 1
};

/// The lines of a text that hold words.
class TextLines {
 public:
  explicit TextLines(std::string_view bytes);

  /// Reads the next line; false at the end of the text.
  bool next(TextLine* line);

 private:
  std::string_view take_line();

  std::string_view rest_;
  std::string joined_;  ///< a line that continues on others
  int number_ = 0;
};

/// Removes the first word of `text` and returns it; empty if there is none.
std::string_view take_word(std::string_view* text);

/// `text` without blanks at both ends.
std::string_view stripped(std::string_view text);

}  // namespace nephroid
