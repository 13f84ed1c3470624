#include "session/report/lamp_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/counted.h"
#include "session/report/short_number.h"

namespace nephroid {

namespace {

/// Maximum number of lights that are named; the rest is summed up.
constexpr size_t kMaxNamedLamps = 5, kMaxNamedDark = 3;

/// Light per lamp of all estimators. Empty if one of them does not count lamps separately.
std::optional<std::vector<LampLight>> lamps_of(const std::vector<EstimatorStatistics>& statistics) {
  std::vector<LampLight> all;
  for (const EstimatorStatistics& s : statistics) {
    if (!s.tells_lamps) return std::nullopt;
    if (s.lamps.empty()) continue;
    if (all.empty()) {
      all = s.lamps;
      continue;
    }
    for (size_t i = 0; i < all.size(); ++i) {
      all[i].light += s.lamps[i].light;
      all[i].rays += s.lamps[i].rays;
    }
  }
  return all;
}

double total_of(const std::vector<LampLight>& lamps) {
  double sum = 0;
  for (const LampLight& lamp : lamps) sum += lamp.light;
  return sum;
}

std::string line_of_shares(const std::vector<LampLight>& brightest, double total) {
  std::string line = "light by lamp:";
  size_t named = brightest.size();
  // A single further light is named as well: "1 others" would not be shorter.
  if (named > kMaxNamedLamps + 1) named = kMaxNamedLamps;
  double rest = total;
  for (size_t i = 0; i < named; ++i) {
    line += fmt::format("{} {} {:.3g} %", i == 0 ? "" : ",", brightest[i].name,
                        100 * brightest[i].light / total);
    rest -= brightest[i].light;
  }
  if (named < brightest.size())
    line += fmt::format(", {} others {:.3g} %", brightest.size() - named,
                        100 * std::max(0.0, rest) / total);
  return line + " (first passes)";
}

/// The likely reason, from shadow rays, why no light reached the camera. `it` names the lights.
std::string reason_of(uint64_t rays, const char* it) {
  if (rays > 0)
    return fmt::format(
        "all {} shadow rays to {}, from what the camera sees directly or by bounces, were blocked, "
        "and no other path found light",
        short_number(static_cast<double>(rays)), it);
  return fmt::format(
      "no shadow ray went to {}: too dim, facing away from what camera paths met, or camera paths "
      "met no rough surface within their depth",
      it);
}

}  // namespace

std::vector<std::string> lamp_report(const std::vector<EstimatorStatistics>& statistics) {
  std::vector<LampLight> lamps = lamps_of(statistics).value_or(std::vector<LampLight>());
  const double total = total_of(lamps);
  if (!(total > 0)) return {};
  std::stable_sort(lamps.begin(), lamps.end(),
                   [](const LampLight& a, const LampLight& b) { return a.light > b.light; });
  std::vector<std::string> lines{line_of_shares(lamps, total)};
  size_t dark = 0;
  for (const LampLight& lamp : lamps)
    if (lamp.light == 0 && ++dark <= kMaxNamedDark)
      lines.push_back(fmt::format("note: {} brought no light in the first passes: {}", lamp.name,
                                  reason_of(lamp.rays, "it")));
  if (dark > kMaxNamedDark)
    lines.push_back("note: " + counted(dark - kMaxNamedDark, "more light") + " brought none");
  return lines;
}

bool is_black(const Film& film) {
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const Rgb value = film.value(x, y);
      if (value.r != 0 || value.g != 0 || value.b != 0) return false;
      if (film.rejection() == nullptr) continue;
      const Rgb held = film.outliers(x, y);
      if (held.r != 0 || held.g != 0 || held.b != 0) return false;
    }
  return true;
}

std::string black_picture_report(const std::vector<EstimatorStatistics>& statistics) {
  const std::string start = "the picture is black, so that no error can be estimated";
  const auto told = lamps_of(statistics);
  if (!told) return start;
  const std::vector<LampLight>& lamps = *told;
  if (std::any_of(statistics.begin(), statistics.end(),
                  [](const EstimatorStatistics& s) { return s.lamp_passes > 0; }) &&
      lamps.empty())
    return start + ": the scene has no light";
  if (lamps.empty()) return start;
  uint64_t rays = 0;
  for (const LampLight& lamp : lamps) rays += lamp.rays;
  if (total_of(lamps) != 0) return start;
  return start + ": " +
         (lamps.size() == 1 ? reason_of(rays, ("the only light, " + lamps[0].name).c_str())
                            : reason_of(rays, fmt::format("its {} lights", lamps.size()).c_str()));
}

}  // namespace nephroid
