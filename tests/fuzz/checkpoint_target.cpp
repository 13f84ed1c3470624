// Render states; see targets.h.
#include <cstring>
#include <span>
#include <vector>

#include "core/content_hash.h"
#include "film/outlier_rejection.h"
#include "fuzz/disk_file.h"
#include "fuzz/targets.h"
#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/film_metadata.h"
#include "session/checkpoint/picture_description.h"
#include "session/report/invalid_samples.h"

namespace nephroid::fuzz {
namespace {

void read(const std::string& path) {
  StateFile file(path);
  const PassRanges passes = passes_of(file, "read it");
  if (PassRanges::parse(passes.text()) != passes) __builtin_trap();
  if (!passes.overlap(passes)) __builtin_trap();
  seconds_of(file, kSecondsKey);
  description_of_picture(path);
  Film film = film_of(file);
  passes_add_up(file);
  file.load(film.state());
  invalid_samples(film);
  // Sums are used as they are in the file.
  const PixelBounds& crop = film.bounds();
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      film.value(x, y);
      film.standard_error(x, y);
    }
  if (!film.has_open_pass() && film.rejection() == nullptr) film.add(Film(film));
}

/// Corrects the checksum of the index in the footer: no fuzzer would find one.
std::string with_right_hash(std::string bytes) {
  constexpr size_t kFooter = 32;
  uint64_t at = 0, size = 0;
  if (bytes.size() < kFooter) return bytes;
  char* const footer = bytes.data() + bytes.size() - kFooter;
  std::memcpy(&at, footer, sizeof(at));
  std::memcpy(&size, footer + 8, sizeof(size));
  if (at > bytes.size() || size > bytes.size() - at) return bytes;
  const uint64_t hash = hash_of(std::as_bytes(std::span(bytes).subspan(at, size)));
  std::memcpy(footer + 16, &hash, sizeof(hash));
  return bytes;
}

/// Held outliers, which checksums protect in a file.
void held(const std::string& bytes) {
  std::vector<uint32_t> words(bytes.size() / 4);
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * 4);
  OutlierSettings settings;
  settings.exposed_pixels = {1, 1};
  OutlierRejection rejection(4, 3, {1, 2}, settings);
  rejection.load(words);
  if (rejection.save().size() > rejection.most_words()) __builtin_trap();
  rejection.held_estimates();
}

}  // namespace

void checkpoint(const std::string& bytes) {
  try {
    if (!bytes.starts_with("NEPHSTA")) return held(bytes);
    const DiskFile file(with_right_hash(bytes), ".state");
    read(file.path());
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
