#include "view/access.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>

#include "core/errors.h"

namespace nephroid {
namespace {

constexpr size_t kRandomBytes = 24;
constexpr const char* kCookieName = "nephroid";

/// 48 hexadecimal digits that nobody can guess.
std::string random_word() {
  std::array<unsigned char, kRandomBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw IoError("the system has no random numbers for the token of the page");
  std::string word;
  for (const unsigned char byte : bytes) word += fmt::format("{:02x}", byte);
  return word;
}

/// An address as it stands in URLs: IPv6 in brackets.
std::string in_url(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

/// A Host header without its port.
std::string_view name_of_host(std::string_view host) {
  const size_t colon = host.rfind(':');
  const size_t bracket = host.rfind(']');
  if (colon == std::string_view::npos) return host;
  if (bracket != std::string_view::npos && bracket > colon) return host;
  return host.substr(0, colon);
}

/// True for an IPv4 or IPv6 address in figures. A name may resolve to anything, an address not.
bool is_address(std::string_view name) {
  if (name.empty()) return false;
  if (name.front() == '[' && name.back() == ']') return true;
  return std::ranges::all_of(name, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

}  // namespace

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

std::string cookie_value(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const size_t end = std::min(header.find(';'), header.size());
    std::string_view pair = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    while (!pair.empty() && pair.front() == ' ') pair.remove_prefix(1);
    const size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name)
      return std::string(pair.substr(equals + 1));
  }
  return {};
}

Access::Access(const std::string& address, int port)
    : address_(address), port_(port), cookie_(random_word()), token_(random_word()) {}

bool Access::take_token(std::string_view token) {
  const std::lock_guard lock(mutex_);
  if (!equal_in_constant_time(token, token_)) return false;
  token_ = random_word();
  return true;
}

std::string Access::url() const {
  // A server that listens everywhere is here, too.
  const std::lock_guard lock(mutex_);
  const bool is_everywhere = address_ == "0.0.0.0" || address_ == "::";
  return fmt::format("http://{}:{}/?token={}", is_everywhere ? "127.0.0.1" : in_url(address_),
                     port_, token_);
}

bool Access::accepts_cookie(std::string_view header) const {
  return equal_in_constant_time(cookie_value(header, fmt::format("{}{}", kCookieName, port_)),
                                cookie_);
}

// Cookies do not know ports, so two views on one machine have two names.
std::string Access::set_cookie() const {
  return fmt::format("{}{}={}; Path=/; HttpOnly; SameSite=Strict", kCookieName, port_, cookie_);
}

bool Access::accepts_host(std::string_view host) const {
  const std::string_view name = name_of_host(host);
  return name == "localhost" || name == in_url(address_) || is_address(name);
}

bool Access::accepts_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view kScheme = "http://";
  return origin.substr(0, kScheme.size()) == kScheme && origin.substr(kScheme.size()) == host;
}

}  // namespace nephroid
