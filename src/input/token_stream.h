// The tokens of a scene file and of all files that it includes, as one stream with one token of
// look-ahead. Called by the parameter reader and by the directive parser.
// Knows the chain of open files, but not what the tokens mean.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/scene_files.h"
#include "input/tokenizer.h"

namespace nephroid {

class TokenStream {
 public:
  /// How deep files may include each other.
  static constexpr size_t kMaxDepth = 64;
  /// How many files may be included in all: files that include the next one twice each would be
  /// read 2^64 times.
  static constexpr size_t kMaxFiles = 65536;

  /// Names in directives are found in `files`, which must outlive the stream.
  explicit TokenStream(SceneFiles& files) : files_of_scene_(files) {}

  /// Starts with the text of a file (`path` as the user gave it). Throws IoError.
  void open_scene(const std::string& path);
  /// Starts with a text in memory; `name` stands for it in messages.
  void open_text(const std::string& text, const std::string& name);

  /// Continues with the file that the string token `file_name` of a directive names; when it ends,
  /// the stream goes on behind the directive (Include). Throws SceneError at the token if the file
  /// cannot be read, includes itself, is nested too deeply or one of too many.
  void include(const Token& file_name);
  /// The same, but the stream stops with kEnd at the end of the file, until leave() (Import).
  void enter(const Token& file_name);
  void leave();

  /// The next token without taking it.
  const Token& peek();
  /// Takes the next token. It is valid until the next call of peek() or next(), as is the text of a
  /// copy.
  const Token& next();
  /// Takes a token of the kind kString; `what` says what the string is, for the message.
  const Token& expect_string(const std::string& what);

 private:
  struct OpenFile {
    std::unique_ptr<Tokenizer> tokenizer;
    std::string shown_path;      // in messages
    std::string canonical_path;  // to find cycles; empty for text in memory
    bool is_scope = false;       // the stream stops at its end
  };

  void push(const Token& file_name, bool is_scope);
  void check_nesting(const Token& file_name, const OpenFile& file) const;
  std::string chain_to(const std::string& last) const;

  SceneFiles& files_of_scene_;
  std::vector<OpenFile> files_;
  size_t files_included_ = 0;
  Token ahead_;
  bool has_ahead_ = false;
};

/// How a scene is called in messages: its path, or "<stdin>".
std::string shown_name(const std::string& scene);

/// How a token reads in a message: the word or string in quotes, or "the end of the file".
std::string describe(const Token& token);

/// The number that a token spells. Throws SceneError at the token if it spells none, or one that is
/// not finite; `what` says what the number is for.
double number_from(const Token& token, const std::string& what);

}  // namespace nephroid
