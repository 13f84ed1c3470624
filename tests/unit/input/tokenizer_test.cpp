// Words, strings, brackets and comments, each with its location.
#include "input/tokenizer.h"

#include <gtest/gtest.h>

#include <sstream>

#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::error_of;

/// All tokens as "kind:text@line:column", kinds w s [ ] and $ for the end.
std::string tokens_of(const std::string& text) {
  Tokenizer tokenizer(std::make_shared<const std::string>("f"), text);
  std::ostringstream all;
  Token token;
  do {
    tokenizer.next(&token);
    const char kinds[] = {'w', 's', '[', ']', '$'};
    const char kind = kinds[static_cast<int>(token.kind)];
    if (all.tellp() > 0) all << ' ';
    all << kind;
    if (kind == 'w' || kind == 's') all << ':' << token.text;
    all << '@' << token.line << ':' << token.column;
  } while (token.kind != Token::Kind::kEnd);
  return all.str();
}

TEST(Tokenizer, SplitsWordsStringsAndBrackets) {
  EXPECT_EQ(tokens_of("Shape \"sphere\" [1 2]"),
            "w:Shape@1:1 s:sphere@1:7 [@1:16 w:1@1:17 w:2@1:19 ]@1:20 $@1:21");
  EXPECT_EQ(tokens_of("a\"b\"c[d]e"), "w:a@1:1 s:b@1:2 w:c@1:5 [@1:6 w:d@1:7 ]@1:8 w:e@1:9 $@1:10");
  EXPECT_EQ(tokens_of(""), "$@1:1");
  EXPECT_EQ(tokens_of("\"\""), "s:@1:1 $@1:3");
}

TEST(Tokenizer, CountsLinesAndColumns) {
  EXPECT_EQ(tokens_of("a\n\tb\r\n  c\n"), "w:a@1:1 w:b@2:2 w:c@3:3 $@4:1");
  EXPECT_EQ(tokens_of("\t\ta"), "w:a@1:3 $@1:4");
}

TEST(Tokenizer, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(tokens_of("\"\xC3\xA9\xE2\x82\xAC\" a\nb"),
            "s:\xC3\xA9\xE2\x82\xAC@1:1 w:a@1:6 w:b@2:1 $@2:2");
}

TEST(Tokenizer, CommentsReachToTheEndOfTheLine) {
  EXPECT_EQ(tokens_of("a # b \"c\n d#e"), "w:a@1:1 w:d#e@2:2 $@2:5");
  EXPECT_EQ(tokens_of("#x"), "$@1:3");
  EXPECT_EQ(tokens_of("\"#\"#"), "s:#@1:1 $@1:5");
}

TEST(Tokenizer, ReplacesEscapes) {
  EXPECT_EQ(tokens_of(R"("a\"b" c)"), "s:a\"b@1:1 w:c@1:8 $@1:9");
  EXPECT_EQ(tokens_of(R"("\b\f\n\r\t\\\'x\"")"), "s:\b\f\n\r\t\\'x\"@1:1 $@1:20");
}

TEST(Tokenizer, SkipsTheByteOrderMark) {
  EXPECT_EQ(tokens_of("\xEF\xBB\xBF"
                      "a"),
            "w:a@1:1 $@1:2");
}

TEST(Tokenizer, ErrorsHaveTheirPlace) {
  EXPECT_EQ(error_of([] { tokens_of("x \"ab\ncd\""); }),
            "f:1:3: the string has no closing quote on its line");
  EXPECT_EQ(error_of([] { tokens_of("\n \"ab"); }),
            "f:2:2: the string has no closing quote on its line");
  EXPECT_EQ(error_of([] { tokens_of("\"ab\\q\""); }),
            "f:1:4: unknown escape in a string, expected \\b \\f \\n \\r \\t \\\\ \\' or \\\"");
  EXPECT_EQ(error_of([] { tokens_of("\"ab\\"); }),
            "f:1:4: unknown escape in a string, expected \\b \\f \\n \\r \\t \\\\ \\' or \\\"");
  EXPECT_EQ(error_of([] { tokens_of("\xFF\xFE"); }),
            "f:1:1: the file is encoded in UTF-16, expected UTF-8");
}

}  // namespace
}  // namespace nephroid
