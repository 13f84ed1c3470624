// Opens, nests and leaves included files. File names are relative to the directory of the scene,
// not of the including file, as in pbrt-v4.
#include "input/token_stream.h"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "input/foreign_file.h"
#include "input/number_text.h"

namespace nephroid {
namespace {

std::string canonical(const std::string& path) {
  std::error_code error;
  const std::filesystem::path result = std::filesystem::weakly_canonical(path, error);
  return error ? path : result.string();
}

}  // namespace

void TokenStream::open_scene(const std::string& path) {
  files_of_scene_.set_top(path);
  const std::string shown = shown_name(path);
  const auto name = std::make_shared<const std::string>(shown);
  std::string text = files_of_scene_.read(path);
  if (const std::string error = foreign_file_error(text, path); !error.empty())
    throw SceneError({name, 1, 1}, error);
  files_.push_back(
      {std::make_unique<Tokenizer>(name, std::move(text)), shown, canonical(path), true});
}

void TokenStream::open_text(const std::string& text, const std::string& name) {
  files_.push_back({std::make_unique<Tokenizer>(std::make_shared<const std::string>(name), text),
                    name, std::string(), true});
}

void TokenStream::include(const Token& file_name) {
  push(file_name, false);
}
void TokenStream::enter(const Token& file_name) {
  push(file_name, true);
}

void TokenStream::leave() {
  files_.pop_back();
  has_ahead_ = false;  // the look-ahead is at most the end of the left file
}

void TokenStream::push(const Token& file_name, bool is_scope) {
  if (file_name.text.empty())
    throw SceneError(file_name.where(), "the file name is empty, expected a scene file");
  OpenFile file;
  file.shown_path = files_of_scene_.path_of(std::string(file_name.text));
  file.canonical_path = canonical(file.shown_path);
  file.is_scope = is_scope;
  check_nesting(file_name, file);
  ++files_included_;
  std::string text;
  try {
    text = files_of_scene_.read(file.shown_path);
  } catch (const IoError& error) {
    throw SceneError(file_name.where(), error.what());
  }
  if (const std::string error = foreign_file_error(text, file.shown_path); !error.empty())
    throw SceneError(file_name.where(), "\"" + file.shown_path + "\": " + error);
  file.tokenizer = std::make_unique<Tokenizer>(std::make_shared<const std::string>(file.shown_path),
                                               std::move(text));
  files_.push_back(std::move(file));
}

void TokenStream::check_nesting(const Token& file_name, const OpenFile& file) const {
  for (const OpenFile& open : files_) {
    if (open.canonical_path == file.canonical_path)
      throw SceneError(file_name.where(), "the file includes itself: " + chain_to(file.shown_path));
  }
  if (files_.size() > kMaxDepth) {
    throw SceneError(file_name.where(),
                     "files are included more than " + std::to_string(kMaxDepth) +
                         " deep, expected fewer levels: " + chain_to(file.shown_path));
  }
  if (files_included_ >= kMaxFiles)
    throw SceneError(file_name.where(), "more than " + std::to_string(kMaxFiles) +
                                            " files are included in all, expected fewer: " +
                                            chain_to(file.shown_path));
}

std::string TokenStream::chain_to(const std::string& last) const {
  std::string chain;
  for (const OpenFile& open : files_) chain += open.shown_path + " -> ";
  return chain + last;
}

const Token& TokenStream::peek() {
  if (!has_ahead_) {
    files_.back().tokenizer->next(&ahead_);
    while (ahead_.kind == Token::Kind::kEnd && !files_.back().is_scope) {
      files_.pop_back();
      files_.back().tokenizer->next(&ahead_);
    }
    has_ahead_ = true;
  }
  return ahead_;
}

const Token& TokenStream::next() {
  peek();
  has_ahead_ = false;
  return ahead_;
}

const Token& TokenStream::expect_string(const std::string& what) {
  const Token& token = next();
  if (token.kind != Token::Kind::kString)
    throw SceneError(token.where(),
                     "expected " + what + " as a string in quotes, found " + describe(token));
  return token;
}

std::string shown_name(const std::string& scene) {
  return scene == kStandardInput ? "<stdin>" : scene;
}

std::string describe(const Token& token) {
  if (token.kind == Token::Kind::kEnd) return "the end of the file";
  constexpr size_t kLongest = 60;
  const std::string shown = token.text.size() <= kLongest
                                ? std::string(token.text)
                                : std::string(token.text.substr(0, kLongest)) + "...";
  return token.kind == Token::Kind::kWord || token.kind == Token::Kind::kString
             ? "\"" + shown + "\""
             : "'" + shown + "'";
}

double number_from(const Token& token, const std::string& what) {
  if (token.kind == Token::Kind::kWord) {
    if (const std::optional<double> value = parse_number(token.text)) {
      if (std::isfinite(*value)) return *value;
      throw SceneError(token.where(),
                       describe(token) + " is not a finite number, expected " + what);
    }
  }
  throw SceneError(token.where(), "expected " + what + ", found " + describe(token));
}

}  // namespace nephroid
