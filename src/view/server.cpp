// The only file that includes the HTTP library.
#include "view/server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "core/errors.h"
#include "view/access.h"
#include "view/answers.h"
#include "view/page_files.h"

namespace nephroid {
namespace {

using httplib::Request;
using httplib::Response;

// A page holds one connection for its events and up to five others.
constexpr size_t kThreads = 48;
constexpr int kMaxEventStreams = 16;
constexpr int kRequestsOfConnection = 1000;
constexpr int kIdleSeconds = 1, kReadSeconds = 5, kWriteSeconds = 10;
constexpr size_t kMaxBody = 64 << 10, kMaxUpload = size_t{512} << 20;  ///< bytes
/// State events are at least so far apart; a comment goes out if there is nothing to say.
constexpr double kSecondsBetweenEvents = 0.1, kLongestSilence = 10;
constexpr const char* kUploadPath = "/api/upload";

const char* const kPolicy =
    "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

void put(Response& response, const Answer& answer) {
  response.status = answer.status;
  response.body = answer.body;
  response.set_header("Content-Type", answer.type);
  if (!answer.file_name.empty())
    response.set_header("Content-Disposition",
                        fmt::format("attachment; filename=\"{}\"", answer.file_name));
}

/// Tells a browser what the page needs, so that it asks for all at once: the first picture, then
/// the scripts, which it would find by their imports only.
std::string preload_links() {
  std::string links = "</api/first>; rel=preload; as=image; fetchpriority=high";
  for (const PageFile& file : page_files())
    if (file.type.starts_with("text/javascript"))
      links += fmt::format(", <{}>; rel=modulepreload", file.path);
  return links;
}

bool is_json(const Request& request) {
  return request.get_header_value("Content-Type").rfind("application/json", 0) == 0;
}

}  // namespace

struct ViewServer::Impl {
  ViewSource& source;
  Comparisons& comparisons;
  Answers answers;
  httplib::Server server;
  std::unique_ptr<Access> access;
  const std::function<void(const std::string&)> on_new_url;
  std::atomic<bool> is_ending{false};
  std::atomic<int> event_streams{0};
  std::mutex upload_mutex;
  std::thread thread;

  Impl(ViewSource& view, Comparisons& others, const ServerSettings& settings)
      : source(view), comparisons(others), answers(view, others, settings.save_directory) {
    server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server.set_keep_alive_max_count(kRequestsOfConnection);
    server.set_keep_alive_timeout(kIdleSeconds);
    server.set_read_timeout(kReadSeconds);
    server.set_write_timeout(kWriteSeconds);
    server.set_payload_max_length(kMaxUpload);
    server.set_tcp_nodelay(true);
    server.set_default_headers({{"Content-Security-Policy", kPolicy},
                                {"Referrer-Policy", "no-referrer"},
                                {"X-Content-Type-Options", "nosniff"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Cross-Origin-Opener-Policy", "same-origin"},
                                {"Cache-Control", "no-store"}});
    server.set_pre_routing_handler([this](const Request& request, Response& response) {
      const Answer refusal = refusal_of(request);
      if (refusal.status == 200) return httplib::Server::HandlerResponse::Unhandled;
      put(response, refusal);
      return httplib::Server::HandlerResponse::Handled;
    });
    server.set_exception_handler([](const Request&, Response& response, std::exception_ptr) {
      put(response, failure(500, "the request failed"));
    });
    server.set_error_handler([](const Request&, Response& response) {
      if (response.body.empty())
        put(response, failure(response.status,
                              response.status == 404 ? "not found" : "the request is not valid"));
    });
    add_page();
    add_requests();
    bind(settings);
    thread = std::thread([this] { server.listen_after_bind(); });
    // stop() does nothing before that.
    while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  ~Impl() {
    is_ending = true;
    server.stop();
    thread.join();
  }

  void bind(const ServerSettings& settings) {
    int port = settings.port;
    // Without SO_REUSEPORT, which would let another process of this user take requests.
    server.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    if (port == 0)
      port = server.bind_to_any_port(settings.address);
    else if (!server.bind_to_port(settings.address, port))
      port = -1;
    if (port < 0)
      throw IoError(
          fmt::format("cannot listen at {}, {}", settings.address,
                      settings.port == 0 ? "any port" : fmt::format("port {}", settings.port)));
    access = std::make_unique<Access>(settings.address, port);
  }

  /// Status 200 if a request may go on; else the answer to it. Bodies are not read yet.
  Answer refusal_of(const Request& request) const {
    const std::string host = request.get_header_value("Host");
    if (!access->accepts_host(host))
      return failure(403, "this server does not answer to that name");
    for (const char* header : {"Range", "Expect", "Transfer-Encoding", "Content-Encoding"})
      if (request.has_header(header))
        return failure(400, fmt::format("expected a request without {}", header));
    // Browsers say so if another page of this machine asks, whose cookies are ours.
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (request.path != "/" && !site.empty() && site != "same-origin")
      return failure(403, "expected a request of the page itself");
    if (request.path == "/" && request.has_param("token")) return {};
    if (!access->accepts_cookie(request.get_header_value("Cookie")))
      return failure(403, "open the address that nephroid printed, with its token");
    if (request.method == "GET" || request.method == "HEAD") return {};
    if (!Access::accepts_origin(request.get_header_value("Origin"), host))
      return failure(403, "expected a request of the page itself");
    const bool is_upload = request.path == kUploadPath;
    if (request.method == "POST" && !is_upload && !is_json(request))
      return failure(415, "expected application/json");
    return size_refusal(request, is_upload);
  }

  static Answer size_refusal(const Request& request, bool is_upload) {
    if (request.method != "POST")
      return request.get_header_value<uint64_t>("Content-Length") > 0
                 ? failure(400, "expected a request without a body")
                 : Answer();
    if (!request.has_header("Content-Length"))
      return failure(411, "expected a request that says its length");
    const uint64_t length = request.get_header_value<uint64_t>("Content-Length");
    if (length > (is_upload ? kMaxUpload : kMaxBody))
      return failure(413, "the request is too long");
    return {};
  }

  void add_page() {
    for (const PageFile& file : page_files()) {
      const auto send = [file](const Request&, Response& response) {
        response.set_content(file.content.data(), file.content.size(), std::string(file.type));
      };
      if (file.path != "/") {
        // A dot in a pattern stands for any character, and only these paths exist.
        server.Get(std::string(file.path), send);
        continue;
      }
      server.Get("/", [this, send](const Request& request, Response& response) {
        if (!request.has_param("token")) {
          response.set_header("Link", preload_links());
          return send(request, response);
        }
        const bool is_known = access->accepts_cookie(request.get_header_value("Cookie"));
        if (!is_known && !access->take_token(request.get_param_value("token")))
          return put(response, failure(403,
                                       "the address was used already, or is not that of this "
                                       "server: nephroid has printed another one"));
        if (!is_known) {
          response.set_header("Set-Cookie", access->set_cookie());
          if (on_new_url) on_new_url(access->url());
        }
        response.set_redirect("/", 303);
      });
    }
  }

  using Method = Answer (Answers::*)(const Parameters&, const std::string& body);

  /// Answers a request by a method of Answers; its errors become answers.
  void answer(Method method, const Request& request, const std::string& body, Response& response) {
    Parameters parameters;
    for (const auto& entry : request.params) parameters.emplace(entry.first, entry.second);
    try {
      put(response, (answers.*method)(parameters, body));
    } catch (const UsageError& error) {
      put(response, failure(400, error.what()));
    } catch (const std::exception& error) {
      put(response, failure(500, error.what()));
    }
  }

  /// The same as a handler of requests whose bodies were read.
  httplib::Server::Handler by(Method method) {
    return [this, method](const Request& request, Response& response) {
      answer(method, request, request.body, response);
    };
  }

  /// One file at a time, so that their sum fits in memory.
  void upload(const Request& request, Response& response, const httplib::ContentReader& read) {
    const auto refuse = [&response](int status, const std::string& message) {
      response.set_header("Connection", "close");  // the body is not read
      put(response, failure(status, message));
    };
    const std::unique_lock lock(upload_mutex, std::try_to_lock);
    if (!lock) return refuse(503, "another picture is being opened, try again");
    if (request.is_multipart_form_data()) return refuse(415, "expected the file as the body");
    std::string body;
    read([&body](const char* data, size_t size) {
      body.append(data, size);
      return true;
    });
    answer(&Answers::upload, request, body, response);
  }

  void add_requests() {
    server.Get("/api/state", by(&Answers::state));
    server.Get("/api/frame", by(&Answers::frame));
    server.Get("/api/first", by(&Answers::first_picture));
    server.Get("/api/probe", by(&Answers::probe));
    server.Get("/api/compare", by(&Answers::compare));
    server.Get("/api/heat", by(&Answers::heat));
    server.Get("/api/save", by(&Answers::save));
    server.Post("/api/camera", by(&Answers::camera));
    server.Post("/api/pick", by(&Answers::pick));
    server.Post("/api/render", by(&Answers::render));
    server.Post("/api/inspect", by(&Answers::inspect));
    server.Post("/api/snapshot", by(&Answers::snapshot));
    server.Post(kUploadPath,
                [this](const Request& request, Response& response,
                       const httplib::ContentReader& read) { upload(request, response, read); });
    server.Delete("/api/snapshot", by(&Answers::remove));
    server.Get("/api/events", [this](const Request&, Response& response) { events(response); });
  }

  void events(Response& response) {
    if (++event_streams > kMaxEventStreams) {
      --event_streams;
      return put(response, failure(503, "too many pages are open"));
    }
    const auto stream = std::make_shared<EventStream>(*this);
    response.set_chunked_content_provider(
        "text/event-stream",
        [stream](size_t, httplib::DataSink& sink) { return stream->write(sink); },
        [this](bool) { --event_streams; });
  }

  /// The events of one page.
  struct EventStream {
    Impl& server;
    uint64_t seen = 0;
    double silence = 0;

    explicit EventStream(Impl& impl) : server(impl) {}

    /// Writes the next event. False if the page has gone.
    bool write(httplib::DataSink& sink) {
      if (server.is_ending) {
        sink.done();
        return true;
      }
      const uint64_t news = server.source.wait_for_news(seen, 1);
      if (news == seen) {
        silence += 1;
        if (!sink.is_writable()) return false;
        if (silence < kLongestSilence) return true;
        silence = 0;
        return send(sink, ":\n\n");
      }
      seen = news;
      silence = 0;
      if (!send(sink, "event: state\ndata: " + server.answers.state({}, {}).body + "\n\n"))
        return false;
      std::this_thread::sleep_for(std::chrono::duration<double>(kSecondsBetweenEvents));
      return true;
    }

    static bool send(httplib::DataSink& sink, const std::string& text) {
      return sink.is_writable() && sink.write(text.data(), text.size());
    }
  };
};

ViewServer::ViewServer(ViewSource& source, Comparisons& comparisons, const ServerSettings& settings)
    : impl_(std::make_unique<Impl>(source, comparisons, settings)) {}
ViewServer::~ViewServer() = default;

std::string ViewServer::url() const {
  return impl_->access->url();
}

}  // namespace nephroid
