// Splits the text of a pbrt-v4 file into words, quoted strings and brackets, each with its
// location. It must not know directives or parameters.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace nephroid {

struct Token {
  enum class Kind { kWord, kString, kOpen, kClose, kEnd };
  Kind kind = Kind::kEnd;
  /// The word, or the string without quotes and with escapes replaced. Valid until the tokenizer
  /// reads the next string or is destroyed.
  std::string_view text;
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  SourceLocation where() const { return {file, line, column}; }
};

class Tokenizer {
 public:
  /// `name` is the name of the text in messages.
  Tokenizer(std::shared_ptr<const std::string> name, std::string text);
  Tokenizer(const Tokenizer&) = delete;
  Tokenizer& operator=(const Tokenizer&) = delete;

  /// The next token; after the last one always kEnd, located after the last character. Throws
  /// SceneError for a string without an end or with an unknown escape.
  void next(Token* token);

 private:
  void skip_blanks_and_comments();
  void read_string(Token* token);
  void start_line();
  /// Columns count characters, so the second and later bytes of a UTF-8 sequence are skipped.
  void pass(char c) {
    if ((static_cast<unsigned char>(c) & 0xC0u) == 0x80u) ++skipped_bytes_;
    ++position_;
  }
  int column() const { return static_cast<int>(position_ - line_start_ - skipped_bytes_ + 1); }

  std::shared_ptr<const std::string> name_;
  std::string text_;
  std::string unescaped_;
  size_t position_ = 0;
  size_t line_start_ = 0;
  size_t skipped_bytes_ = 0;  // in the current line
  int line_ = 1;
};

}  // namespace nephroid
