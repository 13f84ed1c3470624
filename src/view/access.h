// Who may talk to the server: a token in the address, a cookie from then on, and requests that come
// from the page itself (docs/adr/0040-the-view.md). It must not know the HTTP library.
#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// Compares in a time that depends on the lengths alone.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// The value of a cookie in a Cookie header; empty if it is not there.
std::string cookie_value(std::string_view header, std::string_view name);

/// Thread-safe.
class Access {
 public:
  /// For a server at `address` and `port`. Draws token and cookie from the system's random numbers.
  /// Throws IoError if there are none.
  Access(const std::string& address, int port);

  /// The address to open: "http://127.0.0.1:8080/?token=...". It works once.
  std::string url() const;
  /// True if the token is that of url(), which then gets another one.
  bool take_token(std::string_view token);
  /// True if a Cookie header has the cookie.
  bool accepts_cookie(std::string_view header) const;
  /// The Set-Cookie header of a browser that came with the token.
  std::string set_cookie() const;
  /// True if a Host header names this server. A page elsewhere whose name resolves to this address
  /// has its own name there (DNS rebinding). With a port forwarded by ssh, localhost may have
  /// another port.
  bool accepts_host(std::string_view host) const;
  /// True if the Origin header of a request that changes something is that of the page at `host`.
  static bool accepts_origin(std::string_view origin, std::string_view host);

 private:
  std::string address_;
  int port_;
  std::string cookie_;
  mutable std::mutex mutex_;
  std::string token_;
};

}  // namespace nephroid
