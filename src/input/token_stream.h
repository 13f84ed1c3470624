// The tokens of a scene file and of all files that it includes, as one stream with one token of
// look-ahead. It knows the chain of open files; it must not know what the tokens mean.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/scene_files.h"
#include "input/tokenizer.h"

namespace nephroid {

class TokenStream {
 public:
  /// Maximum depth of included files.
  static constexpr size_t kMaxDepth = 64;
  /// Maximum number of included files: if each file included the next one twice, there would be
  /// 2^64.
  static constexpr size_t kMaxFiles = 65536;

  /// Names in directives are resolved by `files`, which must outlive the stream.
  explicit TokenStream(SceneFiles& files) : files_of_scene_(files) {}

  /// Starts with the text of a file; `path` as given by the user. Throws IoError.
  void open_scene(const std::string& path);
  /// Starts with a text in memory; `name` is its name in messages.
  void open_text(const std::string& text, const std::string& name);

  /// Include: continues with the file named by the string token `file_name`, then after the
  /// directive. Throws SceneError at the token if the file cannot be read, includes itself, is
  /// nested too deeply or is one of too many.
  void include(const Token& file_name);
  /// Import: the same, but the stream stops with kEnd at the end of the file, until leave().
  void enter(const Token& file_name);
  void leave();

  /// The next token without taking it.
  const Token& peek();
  /// Takes the next token. It is valid until the next call of peek() or next(), as is the text of a
  /// copy.
  const Token& next();
  /// Takes a token of the kind kString; `what` describes the string in the message.
  const Token& expect_string(const std::string& what);

 private:
  struct OpenFile {
    std::unique_ptr<Tokenizer> tokenizer;
    std::string shown_path;      // for messages
    std::string canonical_path;  // for finding cycles; empty for text in memory
    bool is_scope = false;       // true if the stream stops at its end
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

/// The name of a scene in messages: its path, or "<stdin>".
std::string shown_name(const std::string& scene);

/// A token in messages: the word or string in quotes, or "the end of the file".
std::string describe(const Token& token);

/// The number in a token. Throws SceneError at the token if it is not a finite number; `what`
/// describes the number in the message.
double number_from(const Token& token, const std::string& what);

}  // namespace nephroid
