#include "view/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <span>

#include "core/errors.h"
#include "film/atomic_file.h"
#include "film/film_output.h"
#include "image/mix.h"
#include "input/file_bytes.h"
#include "input/option_values.h"
#include "input/scene_files.h"
#include "input/scene_reader.h"
#include "session/camera_edit.h"
#include "session/camera_text.h"
#include "view/first_picture.h"
#include "view/frame.h"
#include "view/inspection_json.h"
#include "view/json_text.h"
#include "view/live_render.h"
#include "view/saved_file.h"
#include "view/temporary_directory.h"
#include "view/view_requests.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kMaxUploadedValues = int64_t{1} << 28;  ///< pixels times channels
constexpr size_t kMaxLayers = 64;
constexpr double kMaxWaitForPicture = 5;  ///< seconds
constexpr const char *kBinary = "application/octet-stream", *kText = "text/plain; charset=utf-8";

Answer json_answer(const Json& json) {
  Answer answer;
  answer.body = text_of(json);
  return answer;
}

std::string text(const Parameters& parameters, const std::string& name) {
  const auto found = parameters.find(name);
  return found == parameters.end() ? std::string() : found->second;
}

/// A whole number from 0; `missing` if the parameter is not given.
uint64_t number(const Parameters& parameters, const std::string& name,
                std::optional<uint64_t> missing = std::nullopt) {
  const std::string given = text(parameters, name);
  if (given.empty() && missing) return *missing;
  return static_cast<uint64_t>(parse_integer(name, given, 0));
}

/// A coordinate of a pixel.
int coordinate(const Parameters& parameters, const std::string& name) {
  return static_cast<int>(std::min<uint64_t>(number(parameters, name), 1 << 24));
}

bool has_repeats(std::vector<std::string> names) {
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) != names.end();
}

/// The last part of a name, for a file's name without surprises.
std::string safe_stem(const std::string& name) {
  std::string stem = fs::path(name).stem().string();
  for (char& c : stem) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    if (!is_plain) c = '_';
  }
  return stem.empty() || stem.front() == '.' ? "picture" : stem;
}

Answer png_answer(const std::vector<uint8_t>& png) {
  Answer answer;
  answer.type = "image/png";
  answer.body.assign(png.begin(), png.end());
  return answer;
}

/// Camera and film of the present view, without the rest of the scene.
SceneDescription view_of(LiveRender& live) {
  SceneDescription view;
  live.at_rest([&view](const RenderAtRest& rest) {
    view.camera = rest.loaded.description.camera;
    view.film = rest.loaded.description.film;
  });
  const LiveSettings full = live.state().settings;
  set_resolution(&view, full.width, full.height);
  return view;
}

Answer text_answer(std::string body) {
  Answer answer;
  answer.type = kText;
  answer.body = std::move(body);
  return answer;
}

}  // namespace

Answer failure(int status, const std::string& message) {
  Answer answer = json_answer({{"error", message}});
  answer.status = status;
  return answer;
}

Answers::Answers(ViewSource& source, Comparisons& comparisons, std::string save_directory)
    : source_(source), comparisons_(comparisons), save_directory_(std::move(save_directory)) {}

LiveRender& Answers::live() {
  if (LiveRender* live = source_.live()) return *live;
  throw UsageError("this is a picture, expected a scene");
}

std::shared_ptr<const Picture> Answers::comparison(const std::string& id) const {
  if (auto picture = comparisons_.find(id)) return picture;
  throw UsageError("there is no picture '" + id + "' to compare with");
}

Picture Answers::shown(const Parameters& parameters) {
  return source_.colors(parse_shown_mix(text(parameters, "mix"), source_.state().layers));
}

Answer Answers::state(const Parameters&, const std::string&) {
  Answer answer;
  answer.body = state_json(source_.state(), comparisons_.list(), save_directory_);
  return answer;
}

Answer Answers::comparison_frame(const std::string& id) const {
  const std::shared_ptr<const Picture> picture = comparison(id);
  const FrameLayerPtr layers[] = {frame_layer(*picture, kPictureLayer, "RGB", {"R", "G", "B"})};
  FrameInfo info;
  info.version = 1;
  info.width = picture->full_width;
  info.height = picture->full_height;
  info.window = picture->window;
  Answer answer;
  answer.type = kBinary;
  answer.body = encode_frame(info, layers, 0);
  return answer;
}

Answer Answers::frame(const Parameters& parameters, const std::string&) {
  const std::string id = text(parameters, "comparison");
  if (!id.empty()) return comparison_frame(id);
  const std::string names = text(parameters, "layers");
  const std::vector<std::string> layers =
      parse_names("layers", names.empty() ? kPictureLayer : names, "picture,caustic");
  if (layers.size() > kMaxLayers || has_repeats(layers))
    throw UsageError(fmt::format("layers: expected at most {} names, each once", kMaxLayers));
  auto bytes =
      source_.frame(layers, number(parameters, "generation", 0), number(parameters, "since", 0));
  Answer answer;
  answer.type = kBinary;
  if (bytes)
    answer.body = std::move(*bytes);
  else
    answer.status = 204;
  return answer;
}

Answer Answers::first_picture(const Parameters&, const std::string&) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(kMaxWaitForPicture);
  auto picture = source_.picture();
  const auto may_come = [this] {
    const LiveStatus status = source_.state().status;
    return status == LiveStatus::kLoading || status == LiveStatus::kRendering;
  };
  for (uint64_t seen = 0; !picture && may_come(); picture = source_.picture()) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    const uint64_t news = source_.wait_for_news(seen, std::max(0.0, left));
    if (news == seen) break;  // too late, or the program ends
    seen = news;
  }
  if (!picture) {
    Answer none;
    none.status = 204;
    return none;
  }
  return png_answer(first_picture_png(*picture));
}

Answer Answers::probe(const Parameters& parameters, const std::string&) {
  const ProbedPixel pixel = source_.probe(coordinate(parameters, "x"), coordinate(parameters, "y"));
  return json_answer({{"value", json_of(pixel.value)},
                      {"error", json_of(pixel.standard_error)},
                      {"samples", pixel.samples}});
}

Answer Answers::compare(const Parameters& parameters, const std::string&) {
  const std::string id = text(parameters, "with");
  const Distance found = distance(*comparison(id), shown(parameters));
  const auto heat = [&](const char* kind) {
    return fmt::format("/api/heat?with={}&kind={}", id, kind);
  };
  return json_answer({{"relmse", found.relmse},
                      {"relmse_trim", found.relmse_trim},
                      {"flip", found.flip},
                      {"heat", {{"relmse", heat("relmse")}, {"flip", heat("flip")}}}});
}

Answer Answers::heat(const Parameters& parameters, const std::string&) {
  const std::vector<uint8_t> png =
      heat_png(*comparison(text(parameters, "with")), shown(parameters), text(parameters, "kind"));
  return png_answer(png);
}

Answer Answers::deliver(std::string bytes, const std::string& name, const std::string& type) const {
  if (!save_directory_.empty())
    return json_answer(
        {{"saved", save_new_file(save_directory_, name, std::as_bytes(std::span(bytes)))}});
  Answer answer;
  answer.type = type;
  answer.body = std::move(bytes);
  answer.file_name = name;
  return answer;
}

Answer Answers::save(const Parameters& parameters, const std::string&) {
  const std::string kind = text(parameters, "kind");
  const std::string stem = safe_stem(source_.state().name);
  if (kind == "camera") return text_answer(camera_text(view_of(live())));
  if (kind == "scene") return save_scene(stem + "-view.pbrt");
  if (kind != "exr" && kind != "png")
    throw UsageError("kind: '" + kind + "' is not valid, expected exr, png, scene or camera");
  const TemporaryDirectory directory;
  const std::string exr = directory.file(stem + ".exr");
  source_.write(exr);
  if (const std::string mix = text(parameters, "mix"); !mix.empty()) {
    const Picture whole = read_picture(exr);
    write_picture(exr, mixed(whole, parse_mix(mix, mix_layers(whole))), 1, exact_precision(whole));
  }
  if (kind == "png")
    return deliver(read_file_bytes(png_path_beside(exr)), stem + ".png", "image/png");
  return deliver(read_file_bytes(exr), stem + ".exr", "image/x-exr");
}

Answer Answers::save_scene(const std::string& file_name) {
  const fs::path scene = source_.state().name;
  if (scene == kStandardInput)
    throw UsageError("the new camera needs a scene in a file, this one is from standard input");
  if (!is_pbrt_scene(scene.string()))
    throw UsageError(fmt::format(
        "the new camera needs a pbrt scene: nephroid convert {} {}.pbrt, then open that",
        scene.string(), scene.stem().string()));
  return deliver(scene_text_with_camera(view_of(live()), scene.filename().string()), file_name,
                 kText);
}

Answer Answers::camera(const Parameters&, const std::string& body) {
  return json_answer({{"generation", live().move_camera(parse_camera_change(body))}});
}

Answer Answers::pick(const Parameters&, const std::string& body) {
  const PixelRequest pixel = parse_pixel_request(body);
  Json json{{"point", nullptr}, {"depth", nullptr}};
  live().at_rest([&](const RenderAtRest& rest) {
    const Vec2i at = live().pixel_of_render(rest, pixel.x, pixel.y);
    if (const auto seen = seen_point(*rest.loaded.scene, at.x, at.y))
      json = {{"point", json_of(seen->p)}, {"depth", seen->depth}};
  });
  return json_answer(json);
}

Answer Answers::render(const Parameters&, const std::string& body) {
  return json_answer({{"generation", live().change(parse_render_change(body))}});
}

Answer Answers::inspect(const Parameters&, const std::string& body) {
  const PixelRequest pixel = parse_pixel_request(body);
  PixelInspection inspection;
  live().with_picture(
      [&](const RenderAtRest& rest) { inspection = rest.render.inspect(pixel.x, pixel.y); });
  return json_answer(inspection_json(inspection));
}

Answer Answers::snapshot(const Parameters& parameters, const std::string&) {
  const LiveState state = source_.state();
  const std::string description =
      fmt::format("{:.0f} s, {}{}", state.progress.seconds, state.settings.integrator,
                  text(parameters, "mix").empty() ? "" : ", mix");
  return json_answer({{"id", comparisons_.add_snapshot(shown(parameters), description)}});
}

Answer Answers::upload(const Parameters& parameters, const std::string& body) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("upload.exr");
  write_file_atomically(path, std::as_bytes(std::span(body)));
  const std::string name = text(parameters, "name");
  try {
    const PictureHead head = read_picture_head(path);
    if (head.window.area() * static_cast<int64_t>(head.channels.size()) > kMaxUploadedValues)
      throw UsageError(
          fmt::format("{}: the picture is too large, expected at most {} pixels times channels",
                      name, kMaxUploadedValues));
    return json_answer({{"id", comparisons_.add_file(color_picture(read_picture(path)), name)}});
  } catch (const IoError&) {
    throw UsageError(name + ": this is no picture that can be read, expected EXR, PNG or JPEG");
  }
}

Answer Answers::remove(const Parameters& parameters, const std::string&) {
  const std::string id = text(parameters, "id");
  if (!comparisons_.remove(id))
    throw UsageError("there is no picture '" + id + "' to compare with");
  return json_answer(Json::object());
}

}  // namespace nephroid
