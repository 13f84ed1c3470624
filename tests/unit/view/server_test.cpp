// The server of a view: who is let in, what it answers, and what hostile or slow clients can do.
#include "view/server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/errors.h"
#include "film/image_io.h"
#include "input/file_bytes.h"
#include "view/temporary_directory.h"

namespace nephroid {
namespace {

/// A view that shows a grey picture of two pixels.
class GreySource final : public ViewSource {
 public:
  LiveState state() const override {
    LiveState state;
    state.name = name_;
    state.is_scene = false;
    state.status = LiveStatus::kDone;
    return state;
  }
  uint64_t wait_for_news(uint64_t seen, double seconds) const override {
    if (seen == 1) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    return 1;
  }
  std::optional<std::string> frame(const std::vector<std::string>& layers, uint64_t,
                                   uint64_t since) override {
    if (since == 1) return std::nullopt;
    return "frame of " + layers[0] + std::string(payload_, 'x');
  }
  ProbedPixel probe(int x, int y) override {
    check_pixel(x, y, {0, 0, 2, 1});
    return {{0.5f, 0.5f, 0.5f}, {0, 0, 0}, 7};
  }
  Picture colors(const LayerGains&) override {
    Picture picture;
    picture.full_width = 2;
    picture.full_height = 1;
    picture.window = {0, 0, 2, 1};
    picture.channels = {"R", "G", "B"};
    picture.pixels.assign(6, 0.5f);
    return picture;
  }
  void write(const std::string&) override { throw IoError("there is no disk"); }
  void set_payload(size_t bytes) { payload_ = bytes; }
  void set_name(const std::string& name) { name_ = name; }

 private:
  std::string name_ = "grey";
  size_t payload_ = 0;
};

class Server : public ::testing::Test {
 protected:
  Server() {
    const std::string url = server_.url();
    const size_t colon = url.rfind(':'), slash = url.find('/', colon), equals = url.find('=');
    port_ = std::stoi(url.substr(colon + 1, slash - colon - 1));
    token_ = url.substr(equals + 1);
    host_ = "127.0.0.1:" + std::to_string(port_);
  }

  httplib::Client client() const {
    httplib::Client client("127.0.0.1", port_);
    client.set_keep_alive(false);
    return client;
  }

  /// The cookie of a browser that comes with the address of now.
  std::string cookie() const {
    const std::string url = server_.url();
    auto found = client().Get("/?token=" + url.substr(url.find('=') + 1));
    const std::string header = found->get_header_value("Set-Cookie");
    return header.substr(0, header.find(';'));
  }
  httplib::Headers of_browser() const { return {{"Cookie", cookie()}}; }
  httplib::Headers of_page() const { return {{"Cookie", cookie()}, {"Origin", "http://" + host_}}; }

  int status_of_get(const std::string& path, const httplib::Headers& headers) const {
    const auto answer = client().Get(path, headers);
    return answer ? answer->status : 0;
  }
  int status_of_post(const std::string& path, const httplib::Headers& headers,
                     const std::string& body, const std::string& type = "application/json") const {
    const auto answer = client().Post(path, headers, body, type);
    return answer ? answer->status : 0;
  }

  /// A connection on which nothing is sent yet.
  int connection() const {
    const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    return descriptor;
  }
  static void send_text(int descriptor, const std::string& text) {
    EXPECT_EQ(::send(descriptor, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }

  GreySource source_;
  Comparisons comparisons_;
  ViewServer server_{source_, comparisons_, {}};
  int port_ = 0;
  std::string token_, host_;
};

TEST_F(Server, LetsInWhoHasTheTokenAndGivesACookie) {
  const auto answer = client().Get("/?token=" + token_);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 303);
  EXPECT_EQ(answer->get_header_value("Location"), "/");
  EXPECT_EQ(status_of_get("/?token=" + token_, {}), 403) << "the address works once";
  EXPECT_EQ(status_of_get("/?token=" + token_, of_browser()), 303) << "who is in may reload it";
  EXPECT_EQ(status_of_get("/", of_browser()), 200);
  EXPECT_EQ(status_of_get("/api/state", of_browser()), 200);
}

TEST_F(Server, RefusesWhoHasNot) {
  for (const char* path : {"/", "/api/state", "/api/frame", "/api/events", "/api/save?kind=exr"}) {
    EXPECT_EQ(status_of_get(path, {}), 403) << path;
    EXPECT_EQ(status_of_get(path, {{"Cookie", cookie() + "0"}}), 403) << path;
  }
  EXPECT_EQ(status_of_get("/?token=", {}), 403);
  EXPECT_EQ(status_of_get("/?token=" + token_ + "0", {}), 403);
  EXPECT_EQ(status_of_get("/api/state?token=" + token_, {}), 403);
}

TEST_F(Server, SendsHeadersThatKeepOtherPagesOut) {
  const auto answer = client().Get("/", of_browser());
  ASSERT_TRUE(answer);
  EXPECT_NE(answer->get_header_value("Content-Security-Policy").find("default-src 'self'"),
            std::string::npos);
  EXPECT_EQ(answer->get_header_value("Referrer-Policy"), "no-referrer");
  EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(answer->get_header_value("Cross-Origin-Resource-Policy"), "same-origin");
  EXPECT_EQ(answer->get_header_value("Access-Control-Allow-Origin"), "");
}

TEST_F(Server, RefusesNamesOfOtherHosts) {
  httplib::Headers headers = of_browser();
  headers.emplace("Host", "evil.example:" + std::to_string(port_));
  EXPECT_EQ(status_of_get("/api/state", headers), 403);
  EXPECT_EQ(status_of_get("/?token=" + token_, {{"Host", "evil.example"}}), 403);
}

TEST_F(Server, RefusesChangesThatDoNotComeFromThePage) {
  EXPECT_EQ(status_of_post("/api/snapshot", of_page(), "{}"), 200);
  EXPECT_EQ(status_of_post("/api/snapshot", of_browser(), "{}"), 403);
  EXPECT_EQ(status_of_post("/api/snapshot",
                           {{"Cookie", cookie()}, {"Origin", "http://evil.example"}}, "{}"),
            403);
  EXPECT_EQ(status_of_post("/api/snapshot", of_page(), "{}", "text/plain"), 415);
  const auto removed = client().Delete("/api/snapshot?id=A", of_browser());
  EXPECT_EQ(removed->status, 403);
}

TEST_F(Server, ServesNoFileOfTheMachine) {
  for (const char* path : {"/etc/passwd", "/../../etc/passwd", "/..%2f..%2fetc%2fpasswd",
                           "//etc/passwd", "/page.css/../../../etc/passwd", "/server.cpp"})
    EXPECT_EQ(status_of_get(path, of_browser()), 404) << path;
}

TEST_F(Server, AnswersWhatIsWrongWithARequest) {
  const auto error_of = [](const httplib::Result& answer) {
    return nlohmann::json::parse(answer->body)["error"].get<std::string>();
  };
  auto answer = client().Get("/api/probe?x=5&y=0", of_browser());
  EXPECT_EQ(answer->status, 400);
  EXPECT_EQ(error_of(answer), "pixel 5,0 is outside of the picture, expected 0..1,0..0");
  answer = client().Get("/api/probe?x=-1&y=0", of_browser());
  EXPECT_EQ(error_of(answer), "x: '-1' is not valid, expected a whole number from 0");
  answer = client().Get("/api/compare?with=A", of_browser());
  EXPECT_EQ(error_of(answer), "there is no picture 'A' to compare with");
  answer = client().Post("/api/camera", of_page(), "{}", "application/json");
  EXPECT_EQ(error_of(answer), "this is a picture, expected a scene");
  answer = client().Get("/api/save?kind=exr", of_browser());
  EXPECT_EQ(answer->status, 500);
  EXPECT_EQ(error_of(answer), "there is no disk");
}

TEST_F(Server, SaysHowASceneOfAnotherFormatGetsANewCamera) {
  const auto error = [this](const std::string& scene) {
    source_.set_name(scene);
    const auto answer = client().Get("/api/save?kind=scene", of_browser());
    return nlohmann::json::parse(answer->body)["error"].get<std::string>();
  };
  EXPECT_EQ(error("models/vase.glb"),
            "the new camera needs a pbrt scene: nephroid convert models/vase.glb vase.pbrt, then "
            "open that");
  EXPECT_EQ(error("-"), "the new camera needs a scene in a file, this one is from standard input");
}

TEST_F(Server, ComparesWithSnapshots) {
  EXPECT_EQ(status_of_post("/api/snapshot", of_page(), "{}"), 200);
  const auto answer = client().Get("/api/compare?with=A", of_browser());
  const nlohmann::json json = nlohmann::json::parse(answer->body);
  EXPECT_EQ(json["relmse"], 0);
  EXPECT_EQ(json["relmse_trim"], 0);
  EXPECT_EQ(json["flip"], 0);
  const auto heat = client().Get(json["heat"]["flip"].get<std::string>(), of_browser());
  EXPECT_EQ(heat->get_header_value("Content-Type"), "image/png");
  EXPECT_EQ(heat->body.substr(1, 3), "PNG");
  EXPECT_EQ(status_of_get("/api/frame?comparison=A", of_browser()), 200);
}

TEST_F(Server, ComparesWithAPngThatWasUploaded) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("grey.png");
  write_png(path, 2, 1, std::vector<uint8_t>(6, 188));  // the sRGB code of 0.5, rounded
  const std::string png = read_file_bytes(path);
  EXPECT_EQ(status_of_post("/api/upload?name=own.png", of_page(), png, "application/octet-stream"),
            200);
  const auto answer = client().Get("/api/compare?with=file1", of_browser());
  const nlohmann::json json = nlohmann::json::parse(answer->body);
  EXPECT_GT(json["relmse"], 0);  // eight bits are not the whole picture
  EXPECT_LT(json["relmse"], 1e-4);
}

TEST_F(Server, RefusesLongAndMalformedBodies) {
  EXPECT_EQ(status_of_post("/api/render", of_page(), std::string(65 << 10, ' ')), 413);
  EXPECT_EQ(status_of_post("/api/snapshot", of_page(), "not json"), 200);  // has no content
  EXPECT_EQ(
      status_of_post("/api/upload?name=x.exr", of_page(), "no picture", "application/octet-stream"),
      400);
  for (const auto& [name, value] :
       {std::pair("Range", "bytes=0-0,0-0,0-0"), std::pair("Transfer-Encoding", "chunked"),
        std::pair("Content-Encoding", "gzip")}) {
    httplib::Headers headers = of_browser();
    headers.emplace(name, value);
    EXPECT_EQ(status_of_get("/", headers), 400) << name;
  }
  httplib::Headers of_neighbour = of_browser();
  of_neighbour.emplace("Sec-Fetch-Site", "same-site");
  EXPECT_EQ(status_of_get("/api/save?kind=exr", of_neighbour), 403);
  EXPECT_EQ(status_of_get("/api/frame?layers=a,b,a", of_browser()), 400);
  EXPECT_EQ(status_of_get("/" + std::string(9000, 'a'), of_browser()), 414);
}

TEST_F(Server, TakesOneUploadAtATime) {
  const auto upload = [this] {
    return status_of_post("/api/upload?name=x.exr", of_page(), "none", "application/octet-stream");
  };
  const int descriptor = connection();
  send_text(descriptor, "POST /api/upload?name=slow.exr HTTP/1.1\r\nHost: " + host_ +
                            "\r\nCookie: " + cookie() + "\r\nOrigin: http://" + host_ +
                            "\r\nContent-Length: 1000\r\n\r\nsome");
  int status = 0;
  for (int i = 0; i < 100 && status != 503; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // until its headers are read
    status = upload();
  }
  EXPECT_EQ(status, 503);
  ::close(descriptor);
  for (int i = 0; i < 100 && status == 503; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    status = upload();
  }
  EXPECT_EQ(status, 400);
  EXPECT_EQ(
      status_of_post("/api/upload?name=x.exr", of_page(), "--x", "multipart/form-data; boundary=x"),
      415);
}

TEST_F(Server, SurvivesNonsense) {
  for (const std::string text :
       {"\r\n\r\n", "GET\r\n\r\n", "\xff\xfe\x00", "GET / HTTP/9.9\r\n\r\n",
        "POST /api/render HTTP/1.1\r\nHost: localhost\r\nContent-Length: -5\r\n\r\n",
        "POST /api/render HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz",
        "GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=9-1,,,,-,\r\n\r\n"}) {
    const int descriptor = connection();
    send_text(descriptor, text);
    ::close(descriptor);
  }
  const int descriptor = connection();
  send_text(descriptor, "GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=0-");
  for (int i = 0; i < 3500; ++i) send_text(descriptor, ",0");
  send_text(descriptor, "\r\n\r\n");
  ::close(descriptor);
  EXPECT_EQ(status_of_get("/api/state", of_browser()), 200);
}

TEST_F(Server, SurvivesAThousandReconnects) {
  const httplib::Headers headers = of_browser();
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(status_of_get("/api/state", headers), 200) << i;
}

TEST_F(Server, ClosedTabsFreeTheirEvents) {
  const std::string request =
      "GET /api/events HTTP/1.1\r\nHost: " + host_ + "\r\nCookie: " + cookie() + "\r\n\r\n";
  for (int i = 0; i < 40; ++i) {
    const int descriptor = connection();
    send_text(descriptor, request);
    char answer[64];
    const ssize_t count = ::recv(descriptor, answer, sizeof(answer), 0);
    const std::string text(answer, static_cast<size_t>(std::max<ssize_t>(0, count)));
    // When too many are open, those that have gone are found when they are next written to.
    const bool is_served = text.rfind("HTTP/1.1 200", 0) == 0;
    const bool is_refused = text.rfind("HTTP/1.1 503", 0) == 0;
    EXPECT_TRUE(is_served || is_refused) << text;
    ::close(descriptor);
  }
  // After a second or two the server knows that they have gone.
  bool is_served = false;
  for (int i = 0; i < 50 && !is_served; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const int descriptor = connection();
    send_text(descriptor, request);
    char answer[12] = {};
    ::recv(descriptor, answer, sizeof(answer), 0);
    is_served = std::string(answer, sizeof(answer)) == "HTTP/1.1 200";
    ::close(descriptor);
  }
  EXPECT_TRUE(is_served);
}

TEST_F(Server, HalfOpenConnectionsDoNotStopOthers) {
  std::vector<int> descriptors;
  for (int i = 0; i < 20; ++i) {
    descriptors.push_back(connection());
    send_text(descriptors.back(), "GET /api/state HTTP/1.1\r\nHost:");
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(status_of_get("/api/state", of_browser()), 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
  for (const int descriptor : descriptors) ::close(descriptor);
}

TEST_F(Server, ASlowReaderDoesNotStopOthers) {
  source_.set_payload(size_t{64} << 20);
  const int descriptor = connection();
  send_text(descriptor,
            "GET /api/frame HTTP/1.1\r\nHost: " + host_ + "\r\nCookie: " + cookie() + "\r\n\r\n");
  // Nothing is read.
  for (int i = 0; i < 20; ++i) EXPECT_EQ(status_of_get("/api/state", of_browser()), 200);
  ::close(descriptor);
}

TEST_F(Server, EventsBringTheState) {
  std::string events;
  client().Get("/api/events", of_browser(), [&events](const char* data, size_t size) {
    events.append(data, size);
    return events.find("\n\n") == std::string::npos;  // until the first event is whole
  });
  EXPECT_EQ(events.rfind("event: state\ndata: {", 0), 0u) << events;
  EXPECT_NE(events.find("\"scene\":\"grey\""), std::string::npos);
}

TEST_F(Server, AFrameIsSentOnceUnlessItChanges) {
  const auto answer = client().Get("/api/frame?layers=caustic,picture", of_browser());
  EXPECT_EQ(answer->body, "frame of caustic");
  EXPECT_EQ(status_of_get("/api/frame?layers=picture&generation=1&since=1", of_browser()), 204);
}

TEST(ViewServer, APortThatIsTakenIsAnError) {
  GreySource source;
  Comparisons comparisons;
  const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  ASSERT_EQ(::listen(descriptor, 1), 0);
  socklen_t size = sizeof(address);
  ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
  EXPECT_THROW(ViewServer(source, comparisons, {"127.0.0.1", ntohs(address.sin_port), "", {}}),
               IoError);
  ::close(descriptor);
}

}  // namespace
}  // namespace nephroid
