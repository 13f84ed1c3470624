#include "session/report/choices_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/report/lamp_report.h"
#include "session/report/noise.h"
#include "session/report/short_number.h"

namespace nephroid {

namespace {

/// Smaller shares of techniques are not reported.
constexpr double kMinShare = 1e-4;

double part(uint64_t some, uint64_t all) {
  return static_cast<double>(some) / static_cast<double>(all);
}

void add_photons(const EstimatorStatistics& first, const EstimatorStatistics& last, uint32_t passes,
                 std::vector<std::string>& lines) {
  if (last.photon_paths == 0) return;
  const double paths = static_cast<double>(last.photon_paths);
  lines.push_back(fmt::format("photons: {} {}, {} kept in all, {:.3g} % of paths kept any",
                              short_count(last.photons_stay ? paths : paths / passes, "path"),
                              last.photons_stay ? "once" : "per pass",
                              short_count(static_cast<double>(last.photons_stored), "photon"),
                              100 * part(last.photon_paths_useful, last.photon_paths)));
  if (last.radius_max_pixels > 0)
    lines.push_back(
        fmt::format("merge radius: {:.3g} pixels in the first pass to {:.3g} in the last",
                    first.radius_max_pixels, last.radius_min_pixels));
}

void add_light_paths(const EstimatorStatistics& last, uint32_t passes,
                     std::vector<std::string>& lines) {
  if (last.light_paths == 0) return;
  lines.push_back(
      fmt::format("light paths: {} per pass, {} to the camera in all, {:.3g} % of paths had any",
                  short_number(part(last.light_paths, passes)),
                  short_count(static_cast<double>(last.splats), "connection"),
                  100 * part(last.light_paths_useful, last.light_paths)));
}

/// Adds the shares of rays, for estimators that count those of light paths separately.
void add_rays(const EstimatorStatistics& last, std::vector<std::string>& lines) {
  const bool counts_light_rays = last.light_rays > 0 || last.photon_paths + last.light_paths == 0;
  if (last.rays == 0 || !counts_light_rays || last.light_rays + last.learning_rays == 0) return;
  const uint64_t of_camera = last.rays - last.light_rays - last.learning_rays;
  lines.push_back(
      fmt::format("rays: {:.3g} % of camera paths, {:.3g} % of light paths, {:.3g} % to learn",
                  100 * part(of_camera, last.rays), 100 * part(last.light_rays, last.rays),
                  100 * part(last.learning_rays, last.rays)));
}

}  // namespace

std::vector<std::string> technique_report(const std::vector<EstimatorStatistics>& statistics) {
  std::vector<std::string> lines;
  for (const EstimatorStatistics& s : statistics)
    for (const RouteTechniques& r : s.techniques) {
      double all = 0;
      std::vector<std::pair<double, const char*>> found;
      for (const double light : r.light) all += light;
      if (!(all > 0)) continue;
      for (size_t t = 0; t < kTechniqueCount; ++t)
        if (r.light[t] >= kMinShare * all)
          found.push_back({r.light[t], technique_name(static_cast<Technique>(t))});
      std::stable_sort(found.begin(), found.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      std::string line = fmt::format("{}, by technique:", r.route);
      for (size_t i = 0; i < found.size(); ++i)
        line += fmt::format("{} {:.3g} % {}", i == 0 ? "" : ",", 100 * found[i].first / all,
                            found[i].second);
      lines.push_back(line + " (first passes)");
    }
  return lines;
}

std::vector<std::string> choices_report(const std::vector<EstimatorStatistics>& first,
                                        const std::vector<EstimatorStatistics>& last,
                                        uint32_t passes) {
  std::vector<std::string> lines;
  for (size_t i = 0; i < last.size(); ++i) {
    // Within the first pass there are no statistics of it and no rates per pass.
    if (i < first.size() && passes > 0) {
      add_photons(first[i], last[i], passes, lines);
      add_light_paths(last[i], passes, lines);
    }
    add_rays(last[i], lines);
  }
  for (std::string& line : technique_report(last)) lines.push_back(std::move(line));
  for (std::string& line : lamp_report(last)) lines.push_back(std::move(line));
  for (const EstimatorStatistics& s : last)
    for (const std::string& note : s.notes) lines.push_back("note: " + note);
  return lines;
}

std::string text_of_unreached_pixels(const Film& film) {
  return film.can_be_shown()
             ? "pixels that it has not reached are as their neighbours"
             : "some light is missing, and pixels that it has not reached may be black";
}

std::optional<std::string> error_report(const Film& film) {
  const std::optional<ErrorShares> shares = error_shares(film);
  if (!shares) return std::nullopt;
  const FilmLayout& layout = film.layout();
  std::string text = "estimated error:";
  for (size_t g = 0; g < shares->groups.size(); ++g) {
    text += fmt::format("{} {:.3g} % noise", g == 0 ? "" : ",", 100 * shares->groups[g]);
    if (shares->groups.size() == 1) continue;
    const char* before = " of ";
    for (size_t r = 0; r < layout.routes.size(); ++r) {
      if (layout.groups[r] != static_cast<int>(g)) continue;
      text += before + layout.routes[r];
      before = " and ";
    }
  }
  if (film.has_bias()) text += fmt::format(", {:.3g} % bias of merging", 100 * shares->bias);
  return text;
}

}  // namespace nephroid
