// The lexical rules of pbrt-v4 files: blanks separate tokens, "#" starts a comment where a token
// could start, strings end on their line, brackets are tokens.
#include "input/tokenizer.h"

#include <utility>

namespace nephroid {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool ends_word(char c) {
  return is_blank(c) || c == '"' || c == '[' || c == ']';
}

/// The character of the escape sequence with `c`, or 0 if there is none.
char unescape(char c) {
  switch (c) {
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
      return '\\';
    case '\'':
      return '\'';
    case '"':
      return '"';
    default:
      return 0;
  }
}

}  // namespace

Tokenizer::Tokenizer(std::shared_ptr<const std::string> name, std::string text)
    : name_(std::move(name)), text_(std::move(text)) {
  const std::string_view start = std::string_view(text_).substr(0, 3);
  if (start.substr(0, 2) == "\xFE\xFF" || start.substr(0, 2) == "\xFF\xFE")
    throw SceneError({name_, 1, 1}, "the file is encoded in UTF-16, expected UTF-8");
  if (text_.find('\0') != std::string::npos)
    throw SceneError({name_, 1, 1},
                     "the file contains NUL bytes, so it is not text, expected a scene");
  if (start == "\xEF\xBB\xBF") position_ = line_start_ = 3;  // the UTF-8 byte order mark
}

void Tokenizer::start_line() {
  ++line_;
  line_start_ = position_;
  skipped_bytes_ = 0;
}

void Tokenizer::skip_blanks_and_comments() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '#') {
      while (position_ < text_.size() && text_[position_] != '\n' && text_[position_] != '\r')
        pass(text_[position_]);
    } else if (c == '\n') {
      ++position_;
      start_line();
    } else if (is_blank(c)) {
      ++position_;
    } else {
      return;
    }
  }
}

void Tokenizer::next(Token* token) {
  skip_blanks_and_comments();
  if (token->file != name_) token->file = name_;  // spares the reference count
  token->line = line_;
  token->column = column();
  if (position_ == text_.size()) {
    token->kind = Token::Kind::kEnd;
    token->text = {};
    return;
  }
  const size_t start = position_;
  const char first = text_[start];
  if (first == '"') {
    read_string(token);
    return;
  }
  if (first == '[' || first == ']') {
    token->kind = first == '[' ? Token::Kind::kOpen : Token::Kind::kClose;
    ++position_;
  } else {
    token->kind = Token::Kind::kWord;
    while (position_ < text_.size() && !ends_word(text_[position_])) pass(text_[position_]);
  }
  token->text = std::string_view(text_).substr(start, position_ - start);
}

void Tokenizer::read_string(Token* token) {
  token->kind = Token::Kind::kString;
  const size_t start = ++position_;
  bool escaped = false;
  while (position_ < text_.size() && text_[position_] != '"' && text_[position_] != '\n') {
    if (text_[position_] != '\\') {
      pass(text_[position_]);
      continue;
    }
    // Everything before the first backslash is copied once, the rest character by character.
    if (!escaped) unescaped_.assign(text_, start, position_ - start);
    escaped = true;
    const int escape_column = column();
    const char c = position_ + 1 < text_.size() ? unescape(text_[position_ + 1]) : '\0';
    if (c == 0) {
      throw SceneError({name_, line_, escape_column},
                       "unknown escape in a string, expected \\b \\f \\n \\r \\t \\\\ \\' or \\\"");
    }
    unescaped_.push_back(c);
    position_ += 2;
    // Plain characters up to the next backslash or the end.
    while (position_ < text_.size() && text_[position_] != '"' && text_[position_] != '\n' &&
           text_[position_] != '\\') {
      unescaped_.push_back(text_[position_]);
      pass(text_[position_]);
    }
  }
  if (position_ == text_.size() || text_[position_] == '\n')
    throw SceneError(token->where(), "the string has no closing quote on its line");
  token->text = escaped ? std::string_view(unescaped_)
                        : std::string_view(text_).substr(start, position_ - start);
  ++position_;
}

}  // namespace nephroid
