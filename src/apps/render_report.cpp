#include "apps/render_report.h"

#include <fmt/format.h>

#include "core/counted.h"
#include "film/film_output.h"
#include "film/state_file.h"
#include "session/checkpoint/checkpoint.h"
#include "session/report/choices_report.h"
#include "session/report/noise.h"
#include "session/report/short_number.h"

namespace nephroid {
namespace {

std::string summary(const RenderResult& result, const Film& film) {
  uint64_t rays = 0;
  for (const EstimatorStatistics& s : result.statistics) rays += s.rays;
  std::string text =
      fmt::format("{} in {:.1f} s ({})", counted(result.passes_of_run, "pass", "passes"),
                  result.seconds, stop_reason_text(result.reason));
  if (result.passes_done > result.passes_of_run)
    text += fmt::format(", {} in all runs", result.passes_done);
  if (result.has_unfinished_pass)
    text += result.passes_done > 0 ? ", and a part of the next"
                                   : ", and a part of the first: " + text_of_unreached_pixels(film);
  if (rays > 0 && result.seconds > 0)
    text += fmt::format(", {} rays/s", short_number(static_cast<double>(rays) / result.seconds));
  if (rays == 0 && result.passes_done > 0)
    text += result.reason == StopReason::kTime ? "; --time counts all runs: a longer one goes on"
                                               : "; more --passes go on";
  if (result.error) text += fmt::format(", estimated error {:.3g}", *result.error);
  return text + "\n";
}

double all_estimates(const Film& film) {
  double count = 0;
  for (int g = 0; g < film.layout().group_count(); ++g)
    count += static_cast<double>(film.estimates(g)) * static_cast<double>(film.bounds().area());
  return count;
}

std::string route_lines(const Film& film) {
  const EnergyShares shares = energy_shares(film);
  const auto line = [](const char* title, const std::vector<std::string>& names,
                       const std::vector<double>& values) {
    std::string text = title;
    for (size_t i = 0; i < names.size(); ++i)
      text += fmt::format("{} {} {:.3g} %", i == 0 ? "" : ",", names[i], 100 * values[i]);
    return text + "\n";
  };
  std::string text = line("light by route:", film.layout().routes, shares.routes);
  if (!shares.aovs.empty()) text += line("of it in layers:", film.layout().aovs, shares.aovs);
  if (const OutlierRejection* rejection = film.rejection())
    text += fmt::format("outliers: {} of {} held, {:.3g} % of all light (layer 'outliers')\n",
                        counted(rejection->held_estimates(), "estimate"),
                        short_number(all_estimates(film)), 100 * shares.outliers);
  return text;
}

}  // namespace

std::string render_report(const RenderResult& result, const Film& film, const std::string& output) {
  if (!result.has_picture) {
    const std::string kept = output.empty() ? "" : kept_picture(output).value_or("");
    return fmt::format("{} before the first pixels were rendered: there is no {}{}\n",
                       stop_reason_text(result.reason), output.empty() ? "picture" : output,
                       kept.empty() ? "" : ", an earlier one is " + kept);
  }
  std::string text = summary(result, film);
  for (const std::string& line :
       choices_report(result.first_pass_statistics, result.statistics, result.passes_of_run))
    text += line + "\n";
  if (result.error_text) text += *result.error_text + "\n";
  text += route_lines(film);
  for (const std::string& fault : result.faults) text += fmt::format("warning: {}\n", fault);
  if (output.empty()) return text;
  if (result.has_state)
    text += fmt::format("wrote {}, {} and {}, with which {}\n", output, png_path_beside(output),
                        state_path_beside(output),
                        !result.passes_add_up ? "--resume goes on"
                        : result.has_unfinished_pass
                            ? "--resume goes on (merge takes whole passes only)"
                            : "--resume and merge go on");
  else
    text += fmt::format("wrote {} and {}\n", output, png_path_beside(output));
  return text;
}

}  // namespace nephroid
