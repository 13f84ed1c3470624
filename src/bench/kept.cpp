#include "bench/kept.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

#include "core/content_hash.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/atomic_file.h"
#include "input/scene_files.h"
#include "session/checkpoint/version.h"

namespace nephroid {
namespace {

/// Hash of the program: another build may be faster, or correct an error.
uint64_t hash_of_program() {
  static const uint64_t hash = [] {
    const char* self = "/proc/self/exe";
    return std::filesystem::exists(self) ? hash_file(self) : uint64_t{0};
  }();
  return hash;
}

std::string limit_text(const BenchLimit& limit) {
  return limit.passes > 0 ? fmt::format("{} passes", limit.passes)
                          : fmt::format("{} s", limit.seconds);
}

/// A text of everything that a picture depends on.
std::string render_text(const BenchRender& render, uint64_t scene_hash) {
  const BenchScene& scene = *render.scene;
  const RoutePlan plan = plan_of(render);
  std::string text =
      fmt::format("version {}\nscene {:016x} {}x{}\n{}\nseed {}\n", kVersion, scene_hash,
                  scene.width, scene.height, limit_text(render.limit), render.integrator->seed);
  text += routes_text(plan) + "aovs\n" + aovs_text(plan);
  if (render.integrator->reject_outliers) text += "outliers rejected\n";
  for (const auto& [key, value] : settings_of(render)) text += key + "=" + value + "\n";
  return text;
}

}  // namespace

std::string hash_text(const std::string& text) {
  return fmt::format("{:016x}", hash_of(std::as_bytes(std::span(text))));
}

std::string hash_picture(const Picture& p) {
  std::string text = fmt::format("{}x{} {} {} {} {}\n", p.full_width, p.full_height, p.window.x0,
                                 p.window.y0, p.window.x1, p.window.y1);
  for (const std::string& channel : p.channels) text += channel + "\n";
  if (p.color_space != nullptr) text += p.color_space->name();
  ContentHash hash;
  hash.add(std::as_bytes(std::span(text)));
  hash.add(std::as_bytes(std::span(p.pixels)));
  return fmt::format("{:016x}", hash.value());
}

std::string reference_key(const BenchRender& render, uint64_t scene_hash) {
  return hash_text(render_text(render, scene_hash));
}

std::string run_key(const BenchRender& render, uint64_t scene_hash,
                    const std::string& reference_hash) {
  std::string text = render_text(render, scene_hash);
  text +=
      fmt::format("reference {}\nprogram {:016x}\n{}\n{} threads\nexposure {}\n", reference_hash,
                  hash_of_program(), instruction_set(), thread_count(), render.scene->exposure);
  for (const BenchRegion& r : render.scene->regions)
    text += fmt::format("region {} {} {} {} {}\n", r.name, r.x0, r.x1, r.y0, r.y1);
  return hash_text(text);
}

std::string kept_stem(const std::string& directory, const std::string& folder,
                      const std::string& name, const std::string& key) {
  const std::filesystem::path path = std::filesystem::path(directory) / folder;
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw IoError(path.string() + ": cannot make the directory: " + error.message());
  return (path / (name + "-" + key)).string();
}

KeptFiles kept_files(const std::string& directory, const std::string& folder,
                     const std::string& name, const std::string& key) {
  const std::string stem = kept_stem(directory, folder, name, key);
  return {stem + ".json", stem + ".exr"};
}

std::optional<std::string> text_of_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) return std::nullopt;
  return text;
}

void write_text(const std::string& file, const std::string& text) {
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace nephroid
