// One scene of the report: pictures with a slider, tables, plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/fit.h"
#include "bench/html_text.h"
#include "bench/report.h"
#include "bench/svg_plot.h"
#include "core/errors.h"
#include "session/compare.h"
#include "session/flip.h"

namespace nephroid {
namespace {

/// Pictures below this width are shown larger, and then with visible pixels.
constexpr int kSmallWidth = 300;

using Cell = ReportTable::Cell;

struct ShownPicture {
  std::string title, data;
};

std::string display_url(const Picture& picture, float exposure) {
  std::vector<uint8_t> bytes;
  for (const Rgb& color : display_colors(picture, exposure))
    for (int c = 0; c < 3; ++c) bytes.push_back(encode_srgb8(color[c]));
  return png_data_url(picture.width(), picture.height(), bytes);
}

std::vector<const BenchRun*> good_runs(const BenchSceneResult& scene) {
  std::vector<const BenchRun*> runs;
  for (const BenchRun& run : scene.runs)
    if (run.failure.empty()) runs.push_back(&run);
  return runs;
}

/// Reference, runs, and error maps of the runs.
std::vector<ShownPicture> pictures_of(const BenchSceneResult& scene, float exposure) {
  std::vector<ShownPicture> shown, errors;
  const std::vector<const BenchRun*> runs = good_runs(scene);
  Picture reference = read_picture(scene.reference.picture);
  if (!runs.empty()) reference.color_space = RgbColorSpace::find(runs[0]->color_space);
  shown.push_back({"reference", display_url(reference, exposure)});
  for (const BenchRun* run : runs) {
    Picture picture = read_picture(run->picture);
    picture.color_space = reference.color_space;
    shown.push_back({run->integrator, display_url(picture, exposure)});
    errors.push_back({"error of " + run->integrator, png_data_url(picture.width(), picture.height(),
                                                                  heat_map(reference, picture))});
  }
  shown.insert(shown.end(), errors.begin(), errors.end());
  return shown;
}

std::string select(const std::string& label, const std::vector<ShownPicture>& pictures,
                   size_t chosen) {
  std::string html = fmt::format("<select aria-label=\"{}\">", label);
  for (size_t i = 0; i < pictures.size(); ++i)
    html +=
        fmt::format("<option value=\"{}\"{}>{}</option>", i,
                    i == chosen ? " selected=\"selected\"" : "", html_escape(pictures[i].title));
  return html + "</select>";
}

std::string viewer(const BenchSceneResult& scene, float exposure) {
  const std::vector<ShownPicture> pictures = pictures_of(scene, exposure);
  const std::string first = html_escape(pictures[0].title);
  std::string html = fmt::format(
      "<div class=\"view{}\"><div class=\"bar\">{}{}</div><div class=\"stage\">"
      "<img class=\"left\" alt=\"{}\" src=\"{}\"/><img class=\"right\" alt=\"\" src=\"{}\"/>"
      "<span class=\"divider\"></span></div>"
      "<input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" "
      "aria-label=\"How much of the left picture is shown\"/></div>\n",
      scene.width < kSmallWidth ? " small" : "", select("Left picture", pictures, 0),
      select("Right picture", pictures, pictures.size() > 1 ? 1 : 0), first, pictures[0].data,
      pictures[0].data);
  html += fmt::format("<div class=\"strip{}\">", scene.width < kSmallWidth ? " small" : "");
  for (const ShownPicture& picture : pictures)
    html +=
        fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"/><figcaption>{0}</figcaption></figure>\n",
                    html_escape(picture.title), picture.data);
  return html + fmt::format(
                    "</div>\n<p class=\"soft\">Error maps: squared relative error of each "
                    "pixel.</p><div class=\"heat\"></div><div class=\"heat-ends soft\">"
                    "<span>{:g}</span><span>{:g}</span></div>\n",
                    kHeatMin, kHeatMax);
}

/// A column: how a run's value is shown, and how good it is (smaller is better, NaN is neither).
struct Column {
  const char* name;
  std::function<std::string(const BenchRun&)> text;
  std::function<double(const BenchRun&)> badness;
};

std::string table_of(const std::vector<const BenchRun*>& runs, const std::vector<Column>& columns) {
  ReportTable table;
  table.head = {"integrator"};
  for (const BenchRun* run : runs) table.rows.push_back({{html_escape(run->integrator), false}});
  for (const Column& column : columns) {
    table.head.emplace_back(column.name);
    size_t best = runs.size();
    for (size_t i = 0; column.badness && i < runs.size(); ++i)
      if (std::isfinite(column.badness(*runs[i])) &&
          (best == runs.size() || column.badness(*runs[i]) < column.badness(*runs[best])))
        best = i;
    for (size_t i = 0; i < runs.size(); ++i)
      table.rows[i].push_back({column.text(*runs[i]), i == best && runs.size() > 1});
  }
  return table.html();
}

Column error_column(const char* name, double BenchErrors::*error) {
  const auto value = [error](const BenchRun& run) { return run.end().errors.*error; };
  return {name, [value](const BenchRun& run) { return number_text(value(run)); },
          [value](const BenchRun& run) { return std::abs(value(run)); }};
}

std::vector<CurvePoint> curve_of(const BenchRun& run, bool over_time) {
  std::vector<CurvePoint> curve;
  for (const BenchPoint& p : run.points)
    curve.push_back({over_time ? p.seconds : p.passes, p.errors.rmse});
  return curve;
}

Column slope_column(const char* name, bool over_time) {
  const auto slope = [over_time](const BenchRun& run) {
    return log_slope(curve_of(run, over_time)).value_or(std::nan(""));
  };
  return {name, [slope](const BenchRun& run) { return number_text(slope(run)); }, slope};
}

std::string error_table(const std::vector<const BenchRun*>& runs) {
  return table_of(
      runs, {{"passes", [](const BenchRun& r) { return fmt::format("{}", r.end().passes); }, {}},
             {"time", [](const BenchRun& r) { return number_text(r.end().seconds) + " s"; }, {}},
             error_column("RMSE", &BenchErrors::rmse),
             error_column("relMSE", &BenchErrors::relmse),
             error_column("relMSE, trimmed", &BenchErrors::relmse_trim),
             error_column("mean error", &BenchErrors::mean_error),
             error_column("FLIP", &BenchErrors::flip),
             slope_column("slope over passes", false),
             slope_column("slope over time", true)});
}

std::string bytes_or_dash(uint64_t bytes) {
  return bytes == 0 ? "—" : bytes_in_words(static_cast<double>(bytes));
}
std::string count_or_dash(uint64_t count) {
  return count == 0 ? "—" : count_text(static_cast<double>(count));
}

std::string work_table(const std::vector<const BenchRun*>& runs) {
  return table_of(
      runs,
      {{"light paths", [](const BenchRun& r) { return count_or_dash(r.emitted); }, {}},
       {"photons stored", [](const BenchRun& r) { return count_or_dash(r.photons_stored); }, {}},
       {"photon memory", [](const BenchRun& r) { return bytes_or_dash(r.photon_bytes); }, {}},
       {"with pixels' state", [](const BenchRun& r) { return bytes_or_dash(r.bytes); }, {}},
       {"whole program", [](const BenchRun& r) { return bytes_or_dash(r.process_bytes); }, {}},
       {"rays", [](const BenchRun& r) { return count_or_dash(r.rays); }, {}},
       {"rays per second",
        [](const BenchRun& r) { return count_text(static_cast<double>(r.rays) / r.end().seconds); },
        {}}});
}

std::string region_table(const std::vector<const BenchRun*>& runs) {
  std::vector<Column> columns;
  std::vector<std::string> names;
  for (const auto& region : runs[0]->regions) names.push_back("RMSE, " + region.first);
  for (size_t i = 0; i < names.size(); ++i) {
    const auto rmse = [i](const BenchRun& r) {
      return i < r.regions.size() ? r.regions[i].second.rmse : std::nan("");
    };
    columns.push_back(
        {names[i].c_str(), [rmse](const BenchRun& r) { return number_text(rmse(r)); }, rmse});
  }
  return columns.empty() ? "" : "<h3>Regions</h3>\n" + table_of(runs, columns);
}

std::string energy_lines(const BenchSceneResult& scene) {
  const auto line = [](const std::string& of, const BenchShares& shares) {
    std::string html;
    for (const auto& [name, share] : shares)
      html +=
          fmt::format("{}{} {:.3g} %", html.empty() ? "" : ", ", html_escape(name), 100 * share);
    return html.empty()
               ? html
               : fmt::format("<p>Share of the light ({}): {}.</p>\n", html_escape(of), html);
  };
  std::string html = line("reference", scene.reference.energy);
  for (const BenchRun* run : good_runs(scene)) html += line(run->integrator, run->energy);
  return html;
}

std::string plots(const BenchResults& results, const std::vector<const BenchRun*>& runs) {
  std::string legend = "<div class=\"legend\">";
  std::vector<PlotSeries> time, passes;
  for (const BenchRun* run : runs) {
    const auto& all = results.suite.integrators;
    const auto style =
        static_cast<size_t>(results.suite.find_integrator(run->integrator) - &all[0]);
    time.push_back({run->integrator, style, curve_of(*run, true)});
    passes.push_back({run->integrator, style, curve_of(*run, false)});
    legend += "<span>" + svg_line_sample(style) + html_escape(run->integrator) + "</span>";
  }
  return legend + "</div>\n<div class=\"plots\">" +
         svg_log_plot("Error over time", "seconds", "RMSE", time) +
         svg_log_plot("Error over passes", "passes", "RMSE", passes) + "</div>\n";
}

std::string facts(const BenchScene& scene, const BenchSceneResult& result) {
  const BenchReferenceResult& r = result.reference;
  std::string text =
      fmt::format("{}, {} × {} pixels. Reference: ", scene.file, result.width, result.height);
  if (r.rendered)
    text += fmt::format("rendered with {}, {} passes in {:.4g} s",
                        name_of(scene.reference.integrator.routes, ""), r.passes, r.seconds);
  else
    text += r.picture;
  if (r.own_error)
    text += fmt::format("; its own RMS error, as it estimates it, is {:.3g}", *r.own_error);
  return "<p class=\"facts\">" + html_escape(text) + ".</p>\n";
}

std::string settings(const std::vector<const BenchRun*>& runs) {
  std::string html = "<details><summary>Routes, options and notes</summary>\n";
  for (const BenchRun* run : runs) {
    html += fmt::format("<h3>{}</h3><pre>{}{}</pre>\n", html_escape(run->integrator),
                        html_escape(run->routes), html_escape(run->options));
    for (const std::string& note : run->notes) html += "<p>" + html_escape(note) + "</p>\n";
  }
  return html + "</details>\n";
}

}  // namespace

std::string report_of_scene(const BenchResults& results, const BenchSceneResult& result) {
  const BenchScene& scene = *results.suite.find_scene(result.name);
  std::string html =
      fmt::format("<section><h2 id=\"scene-{}\">{}</h2>\n", scene.name, html_escape(scene.title));
  const auto failure = [&](const std::string& text) {
    html += "<p class=\"failure\">" + html_escape(text) + "</p>\n";
  };
  if (!result.failure.empty()) {
    failure(result.failure);
    return html + "</section>\n";
  }
  for (const BenchRun& run : result.runs)
    if (!run.failure.empty()) failure(run.integrator + ": " + run.failure);
  if (result.reference.picture.empty()) {
    failure("stopped before the reference was finished");
    return html + "</section>\n";
  }
  html += facts(scene, result);
  try {
    html += viewer(result, scene.exposure);
  } catch (const Error& error) {
    failure(error.what());
  }
  const std::vector<const BenchRun*> runs = good_runs(result);
  if (!runs.empty())
    html += "<h3>Errors</h3>\n" + error_table(runs) + region_table(runs) + plots(results, runs) +
            "<h3>Work and memory</h3>\n" + work_table(runs) + energy_lines(result) + settings(runs);
  return html + "</section>\n";
}

}  // namespace nephroid
