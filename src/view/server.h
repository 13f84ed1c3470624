// The HTTP server of a view: one page, its pictures and its requests. docs/view-protocol.md has the
// protocol, docs/adr/0040-the-view.md what is trusted. It must not know how a picture is rendered.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "view/comparisons.h"
#include "view/view_source.h"

namespace nephroid {

struct ServerSettings {
  std::string address = "127.0.0.1";
  int port = 0;                ///< 0: any that is free
  std::string save_directory;  ///< of what the page saves; empty: it is downloaded
  /// Called with the address for another browser, by any thread, when one has come.
  std::function<void(const std::string& url)> on_new_url;
};

class ViewServer {
 public:
  /// Begins to serve, on threads of its own, until the end of its lifetime. Keeps references to
  /// source and comparisons. Throws IoError if the port cannot be used.
  ViewServer(ViewSource& source, Comparisons& comparisons, const ServerSettings& settings);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// The address of the page, with its token.
  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid
