// Who may talk to the server of a view.
#include "view/access.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(Access, TheUrlHasATokenThatNobodyCanGuess) {
  Access access("127.0.0.1", 8080), other("127.0.0.1", 8080);
  const std::string start = "http://127.0.0.1:8080/?token=";
  ASSERT_EQ(access.url().substr(0, start.size()), start);
  const std::string token = access.url().substr(start.size());
  EXPECT_EQ(token.size(), 48u);
  EXPECT_FALSE(other.take_token(token));
  EXPECT_FALSE(access.take_token(""));
  EXPECT_FALSE(access.take_token(token.substr(1)));
  EXPECT_FALSE(access.take_token(token + "0"));
  EXPECT_TRUE(access.take_token(token));
  EXPECT_FALSE(access.take_token(token)) << "it works once";
  EXPECT_TRUE(access.take_token(access.url().substr(start.size())));
}

TEST(Access, AServerThatListensEverywhereIsAtHomeInItsUrl) {
  EXPECT_EQ(Access("0.0.0.0", 80).url().substr(0, 20), "http://127.0.0.1:80/");
  EXPECT_EQ(Access("::1", 80).url().substr(0, 16), "http://[::1]:80/");
}

TEST(Access, TheCookieIsNotTheToken) {
  const Access access("127.0.0.1", 8080);
  const std::string header = access.set_cookie();
  EXPECT_NE(header.find("; HttpOnly"), std::string::npos);
  EXPECT_NE(header.find("; SameSite=Strict"), std::string::npos);
  const std::string cookie = header.substr(0, header.find(';'));
  EXPECT_TRUE(access.accepts_cookie(cookie));
  EXPECT_TRUE(access.accepts_cookie("a=b; " + cookie + "; c=d"));
  EXPECT_FALSE(access.accepts_cookie("a=b"));
  EXPECT_FALSE(access.accepts_cookie(""));
  EXPECT_FALSE(access.accepts_cookie(cookie.substr(0, cookie.size() - 1)));
  const std::string token = access.url().substr(access.url().find('=') + 1);
  EXPECT_FALSE(access.accepts_cookie(cookie.substr(0, cookie.find('=') + 1) + token));
}

TEST(Access, CookiesAreFoundByTheirWholeName) {
  EXPECT_EQ(cookie_value("a=1; b=2", "b"), "2");
  EXPECT_EQ(cookie_value("ab=1; b=2;", "b"), "2");
  EXPECT_EQ(cookie_value("b", "b"), "");
  EXPECT_EQ(cookie_value(";;;", "b"), "");
  EXPECT_EQ(cookie_value("b=x=y", "b"), "x=y");
}

TEST(Access, NamesOfOtherHostsAreRefused) {
  const Access access("127.0.0.1", 8080);
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "localhost:9000", "localhost",
                           "[::1]:8080", "192.168.1.7:8080"})
    EXPECT_TRUE(access.accepts_host(host)) << host;
  for (const char* host : {"", "evil.example", "evil.example:8080", "127.0.0.1.evil.example",
                           "localhost.evil.example:8080", "127.0.0.1x:8080", ":8080"})
    EXPECT_FALSE(access.accepts_host(host)) << host;
}

TEST(Access, ANameToListenAtIsItsOwnHost) {
  EXPECT_TRUE(Access("farm7", 80).accepts_host("farm7:80"));
  EXPECT_FALSE(Access("farm7", 80).accepts_host("farm8:80"));
}

TEST(Access, ChangesComeFromThePageItself) {
  EXPECT_TRUE(Access::accepts_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  for (const char* origin : {"", "null", "http://evil.example", "https://127.0.0.1:8080",
                             "http://127.0.0.1:8081", "http://127.0.0.1:8080.evil.example"})
    EXPECT_FALSE(Access::accepts_origin(origin, "127.0.0.1:8080")) << origin;
}

}  // namespace
}  // namespace nephroid
