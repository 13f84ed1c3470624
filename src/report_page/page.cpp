// The page around the scenes: head, claims, summary, and the command that repeats it.
#include "report_page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/figure_text.h"
#include "bench/kept.h"
#include "bench/repeats.h"
#include "core/counted.h"
#include "core/errors.h"
#include "image/compare.h"
#include "report_page/html_text.h"

namespace nephroid {
namespace {

std::string paragraphs(const std::string& text) {
  std::string html;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find("\n\n", begin), text.size());
    html += "<p>" + html_escape(text.substr(begin, end - begin)) + "</p>\n";
    begin = std::min(text.find_first_not_of('\n', end), text.size());
  }
  return html;
}

std::string style_with_heat() {
  constexpr int kStops = 24;
  std::string stops;
  for (int i = 0; i <= kStops; ++i) {
    const double t = static_cast<double>(i) / kStops;
    const HeatColor c = heat_color(kHeatMin * std::pow(kHeatMax / kHeatMin, t));
    stops += fmt::format("{}#{:02x}{:02x}{:02x}", i == 0 ? "" : ",", c.r, c.g, c.b);
  }
  std::string style = kReportStyle;
  const std::string mark = "HEATSTOPS";
  return style.replace(style.find(mark), mark.size(), stops);
}

const std::string& title_of(const BenchResults& results, const std::string& scene) {
  return results.suite.find_scene(scene)->title;
}

std::string navigation(const BenchResults& results) {
  std::string html = "<nav aria-label=\"Sections\">";
  if (!results.suite.claims.empty()) html += "<a href=\"#claims\">Claims</a>";
  html += "<a href=\"#summary\">Summary</a>";
  for (const BenchSceneResult& scene : results.scenes)
    html += fmt::format("<a href=\"#scene-{}\">{}</a>", scene.name,
                        html_escape(title_of(results, scene.name)));
  return html + "<a href=\"#again\">How to repeat it</a></nav>\n";
}

std::string claim_html(const BenchResults& results, const BenchClaim& claim,
                       const BenchVerdict& verdict) {
  const bool holds = verdict.state == BenchVerdict::State::kHolds;
  const bool fails = verdict.state == BenchVerdict::State::kFails;
  std::string html = fmt::format("<li class=\"{}\"><p><b>{}</b>{}</p>",
                                 holds   ? "holds"
                                 : fails ? "fails"
                                         : "unknown",
                                 holds   ? "✓ holds"
                                 : fails ? "✗ does not hold"
                                         : "– not measured",
                                 html_escape(claim.text));
  if (!verdict.figures.empty()) {
    html += "<ul>";
    for (const BenchFigure& figure : verdict.figures)
      html += fmt::format("<li class=\"{}\"><b>{}</b> {}</li>", figure.holds ? "yes" : "no",
                          html_escape(title_of(results, figure.scene)), html_escape(figure.text));
    html += "</ul>";
  }
  return html + "</li>\n";
}

std::string claims_section(const BenchResults& results) {
  if (results.suite.claims.empty()) return {};
  size_t held = 0;
  std::string list;
  for (size_t i = 0; i < results.verdicts.size(); ++i) {
    held += results.verdicts[i].state == BenchVerdict::State::kHolds;
    list += claim_html(results, results.suite.claims[i], results.verdicts[i]);
  }
  return fmt::format(
      "<h2 id=\"claims\">Claims</h2>\n<p>{} of {} hold.</p>\n"
      "<ul class=\"claims\">\n{}</ul>\n",
      held, results.verdicts.size(), list);
}

/// A table of the RMSE of every integrator on every scene.
std::string summary_section(const BenchResults& results) {
  ReportTable table;
  table.head = {"RMSE"};
  for (const BenchIntegrator& integrator : results.suite.integrators)
    table.head.push_back(integrator.name);
  table.head.emplace_back("reference’s own");
  for (const BenchSceneResult& scene : results.scenes) {
    std::vector<ReportTable::Cell> row = {{fmt::format("<a href=\"#scene-{}\">{}</a>", scene.name,
                                                       html_escape(title_of(results, scene.name))),
                                           false}};
    const BenchRun* best = nullptr;
    for (const BenchRun& run : scene.runs)
      if (run.failure.empty() &&
          (best == nullptr || errors_at_end(run).rmse < errors_at_end(*best).rmse))
        best = &run;
    for (const BenchIntegrator& integrator : results.suite.integrators) {
      const BenchRun* run = scene.find_run(integrator.name);
      row.push_back({run == nullptr ? "" : rmse_text(*run), run != nullptr && run == best});
    }
    const std::optional<double>& own = scene.reference.own_error;
    row.push_back({own ? number_text(*own) : "—", false});
    table.rows.push_back(std::move(row));
  }
  return "<h2 id=\"summary\">Summary</h2>\n<p>Root mean square error against the reference at the "
         "end of each run; a star marks the smallest. Where runs were repeated with other seeds, "
         "the mean is over all of them, and the smallest and the largest RMSE of one picture "
         "follow. Last is the error that the reference itself estimates that it has.</p>\n" +
         table.html();
}

std::string again_section(const BenchResults& results) {
  const BenchMachine& m = results.machine;
  return fmt::format(
      "<h2 id=\"again\">How to repeat it</h2>\n<pre>{}</pre>\n"
      "<p>Nephroid {}; instruction set {}; {} on {}; {}. Pictures of the same number of "
      "passes have the same bits for any number of threads; how many passes fit into a time "
      "depends "
      "on the machine and on what else it does.</p>\n"
      "<p>Time is that of rendering, from the first pass to the end of the last, without loading "
      "the scene and without measuring. Slopes are of the straight line through the logarithms of "
      "RMSE over the second half of a run: −0.5 is what independent samples give. The star marks "
      "the best of a column. Where runs were repeated, pictures, curves, slopes, time and work are "
      "those of the first render. An error without the reference’s is the root of the difference "
      "of "
      "their squares, an estimate of the error against the truth; it is negative where the "
      "reference’s is the larger. results.json, runs.csv and curves.csv in the same directory have "
      "all "
      "figures.</p>\n",
      html_escape(m.command), html_escape(m.version), html_escape(m.instruction_set),
      counted(m.threads, "thread"), html_escape(m.processor), html_escape(m.date));
}

}  // namespace

std::string ReportTable::html() const {
  std::string html = "<div class=\"wide\"><table><thead><tr>";
  for (const std::string& name : head) html += "<th>" + html_escape(name) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const std::vector<Cell>& row : rows) {
    html += "<tr>";
    for (const Cell& cell : row)
      html += (cell.best ? "<td class=\"best\">" : "<td>") + cell.html + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string rmse_text(const BenchRun& run) {
  const std::string rmse = number_text(errors_at_end(run).rmse);
  const size_t renders = renders_of(run).size();
  if (renders == 1) return rmse;
  const RmseRange range = rmse_range(run);
  return fmt::format("{} ({} renders: {} to {})", rmse, renders, number_text(range.least),
                     number_text(range.most));
}

std::string bench_report(const BenchResults& results) {
  const BenchSuite& suite = results.suite;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      html_escape(suite.title) + "</title>\n<style>" + style_with_heat() +
      "</style>\n</head>\n<body>\n<h1>" + html_escape(suite.title) + "</h1>\n" +
      paragraphs(suite.description) + navigation(results);
  if (results.signal != 0)
    html +=
        "<p class=\"failure\">The benchmark was stopped before its end. The same command goes on "
        "where it stopped.</p>\n";
  if (results.failures() > 0)
    html += fmt::format("<p class=\"failure\">{} of this benchmark failed, see below.</p>\n",
                        counted(results.failures(), "part"));
  html += claims_section(results) + summary_section(results);
  for (const BenchSceneResult& scene : results.scenes) html += report_of_scene(results, scene);
  return html + again_section(results) + "<script>" + kReportScript +
         "</script>\n</body>\n</html>\n";
}

void write_report(const std::string& results_file, const std::string& page_file) {
  const auto text = text_of_file(results_file);
  if (!text) throw IoError("'" + results_file + "' cannot be read");
  write_text(page_file, bench_report(results_from_json(*text, results_file)));
}

}  // namespace nephroid
