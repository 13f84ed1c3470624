// One scene of the report: pictures with a slider, tables, plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "bench/figure_text.h"
#include "bench/fit.h"
#include "bench/repeats.h"
#include "core/counted.h"
#include "core/errors.h"
#include "image/compare.h"
#include "image/flip.h"
#include "report_page/html_text.h"
#include "report_page/page.h"
#include "report_page/svg_plot.h"
#include "session/report/short_number.h"

namespace nephroid {
namespace {

/// Pictures narrower than this are enlarged, with visible pixels.
constexpr int kSmallWidth = 300;

using Cell = ReportTable::Cell;

struct ShownPicture {
  std::string title, data, error_data;  ///< error map; none of the reference
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

/// The pictures of the reference and of the runs.
std::vector<ShownPicture> pictures_of(const BenchSceneResult& scene, float exposure) {
  std::vector<ShownPicture> shown;
  const std::vector<const BenchRun*> runs = good_runs(scene);
  const Picture reference = read_picture(scene.reference.picture);
  shown.push_back({"reference", display_url(reference, exposure), {}});
  for (const BenchRun* run : runs) {
    const Picture picture = read_picture(run->picture);
    shown.push_back(
        {run->integrator, display_url(picture, exposure),
         png_data_url(picture.width(), picture.height(), heat_map(reference, picture))});
  }
  return shown;
}

/// A selection of pictures: picture i has the number 2 i, its error map 2 i + 1.
std::string select(const std::string& label, const std::vector<ShownPicture>& pictures,
                   size_t chosen) {
  std::string html = fmt::format("<label>{} <select>", label);
  const auto add = [&](size_t number, const std::string& title) {
    html += fmt::format("<option value=\"{}\"{}>{}</option>", number,
                        number == chosen ? " selected=\"selected\"" : "", html_escape(title));
  };
  for (size_t i = 0; i < pictures.size(); ++i) add(2 * i, pictures[i].title);
  for (size_t i = 1; i < pictures.size(); ++i) add(2 * i + 1, "error of " + pictures[i].title);
  return html + "</select></label>";
}

std::string figure(size_t number, const std::string& title, const std::string& data) {
  return fmt::format(
      "<figure><img data-picture=\"{}\" alt=\"{}\" "
      "src=\"{}\"/><figcaption>{}</figcaption></figure>",
      number, html_escape(title), data, html_escape(title));
}

/// A column for each picture with its error map below it; below the reference is the maps' scale.
std::string strip(const std::vector<ShownPicture>& pictures, bool small) {
  std::string html = fmt::format("<div class=\"strip{}\">\n", small ? " small" : "");
  for (size_t i = 0; i < pictures.size(); ++i) {
    html += "<div>" + figure(2 * i, pictures[i].title, pictures[i].data);
    if (i == 0)
      html += fmt::format(
          "<p class=\"soft\">Error maps show the squared relative error of each pixel:</p>"
          "<div class=\"heat\"></div><div class=\"heat-ends soft\"><span>{:g}</span>"
          "<span>{:g}</span></div>",
          kHeatMin, kHeatMax);
    else
      html += figure(2 * i + 1, "error of " + pictures[i].title, pictures[i].error_data);
    html += "</div>\n";
  }
  return html + "</div>\n";
}

std::string viewer(const BenchSceneResult& scene, float exposure) {
  const std::vector<ShownPicture> pictures = pictures_of(scene, exposure);
  const bool small = scene.width < kSmallWidth;
  const std::string first = html_escape(pictures[0].title);
  return fmt::format(
             "<div class=\"view{}\"><div class=\"bar\">{}{}</div><div class=\"stage\">"
             "<img class=\"left\" alt=\"{}\" src=\"{}\"/>"
             "<img class=\"right\" alt=\"\" src=\"{}\"/><span class=\"divider\"></span></div>"
             "<input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" "
             "aria-label=\"How much of the left picture is shown\"/></div>\n",
             small ? " small" : "", select("left", pictures, 0),
             select("right", pictures, pictures.size() > 1 ? 2 : 0), first, pictures[0].data,
             pictures[0].data) +
         strip(pictures, small);
}

/// A table column: a run's value as text, and its rank (smaller is better, NaN is not ranked).
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
  const auto value = [error](const BenchRun& run) { return errors_at_end(run).*error; };
  return {name, [value](const BenchRun& run) { return number_text(value(run)); },
          [value](const BenchRun& run) { return std::abs(value(run)); }};
}

enum class Over { kTime, kPasses, kEmitted };

/// The curve of the RMSE of the picture, or of a layer given by its index.
std::vector<CurvePoint> curve_of(const BenchRun& run, Over over,
                                 std::optional<size_t> layer = std::nullopt) {
  std::vector<CurvePoint> curve;
  for (const BenchPoint& p : run.points) {
    const double x = over == Over::kTime     ? p.seconds
                     : over == Over::kPasses ? p.passes
                                             : static_cast<double>(p.emitted);
    if (!layer || *layer < p.layers.size())
      curve.push_back({x, (layer ? p.layers[*layer].second : p.errors).rmse});
  }
  return curve;
}

Column slope_column(const char* name, Over over) {
  return {name,
          [over](const BenchRun& run) {
            return number_text(log_slope(curve_of(run, over)).value_or(std::nan("")));
          },
          {}};
}

std::string error_table(const std::vector<const BenchRun*>& runs,
                        const std::optional<double>& own_error) {
  std::vector<Column> columns = {
      {"passes", [](const BenchRun& r) { return fmt::format("{}", r.end().passes); }, {}},
      {"time", [](const BenchRun& r) { return seconds_in_words(r.end().seconds); }, {}},
      {"RMSE", rmse_text, [](const BenchRun& r) { return errors_at_end(r).rmse; }}};
  if (own_error)
    columns.push_back({"without reference’s",
                       [&](const BenchRun& r) {
                         return number_text(without_reference(errors_at_end(r).rmse, *own_error));
                       },
                       {}});
  for (Column& column :
       std::vector<Column>{error_column("relMSE", &BenchErrors::relmse),
                           error_column("relMSE, trimmed", &BenchErrors::relmse_trim),
                           error_column("mean error", &BenchErrors::mean_error),
                           error_column("FLIP", &BenchErrors::flip),
                           slope_column("slope over passes", Over::kPasses),
                           slope_column("slope over time", Over::kTime)})
    columns.push_back(std::move(column));
  return table_of(runs, columns);
}

std::string bytes_or_dash(uint64_t bytes) {
  return bytes == 0 ? "—" : short_bytes(static_cast<double>(bytes));
}
std::string count_or_dash(uint64_t count) {
  return count == 0 ? "—" : short_number(static_cast<double>(count));
}

std::string work_table(const std::vector<const BenchRun*>& runs) {
  return table_of(
      runs,
      {{"light paths", [](const BenchRun& r) { return count_or_dash(r.emitted); }, {}},
       {"photons stored", [](const BenchRun& r) { return count_or_dash(r.photons_stored); }, {}},
       {"photon memory", [](const BenchRun& r) { return bytes_or_dash(r.photon_bytes); }, {}},
       {"memory of pixels", [](const BenchRun& r) { return bytes_or_dash(r.pixel_bytes); }, {}},
       {"both", [](const BenchRun& r) { return bytes_or_dash(r.bytes); }, {}},
       {"whole program", [](const BenchRun& r) { return bytes_or_dash(r.process_bytes); }, {}},
       {"rays", [](const BenchRun& r) { return count_or_dash(r.rays); }, {}},
       {"rays per second",
        [](const BenchRun& r) {
          return short_number(static_cast<double>(r.rays) / r.end().seconds);
        },
        {}}});
}

/// A table of the RMSE at the end in each region or layer.
std::string parts_table(const std::string& title, const std::vector<const BenchRun*>& runs,
                        const std::function<BenchNamedErrors(const BenchRun&)>& parts) {
  std::vector<Column> columns;
  std::vector<std::string> names;
  for (const auto& part : parts(*runs[0])) names.push_back("RMSE, " + part.first);
  for (size_t i = 0; i < names.size(); ++i) {
    const auto rmse = [i, &parts](const BenchRun& r) {
      const BenchNamedErrors errors = parts(r);
      return i < errors.size() ? errors[i].second.rmse : std::nan("");
    };
    columns.push_back(
        {names[i].c_str(), [rmse](const BenchRun& r) { return number_text(rmse(r)); }, rmse});
  }
  return columns.empty() ? "" : "<h3>" + title + "</h3>\n" + table_of(runs, columns);
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
  const auto& all = results.suite.integrators;
  std::string legend = "<div class=\"legend\">";
  std::vector<size_t> styles;
  for (const BenchRun* run : runs) {
    styles.push_back(results.suite.find_integrator(run->integrator) - &all[0]);
    legend += "<span>" + svg_line_sample(styles.back()) + html_escape(run->integrator) + "</span>";
  }
  const auto plot = [&](const std::string& title, const char* x, Over over,
                        std::optional<size_t> layer = std::nullopt) {
    std::vector<PlotSeries> series;
    for (size_t i = 0; i < runs.size(); ++i)
      series.push_back({runs[i]->integrator, styles[i], curve_of(*runs[i], over, layer)});
    return svg_log_plot(title, x, "RMSE", series);
  };
  std::string html = "<h3>How errors fall</h3>\n" + legend + "</div>\n<div class=\"plots\">" +
                     plot("Error over time", "seconds", Over::kTime) +
                     plot("Error over passes", "passes", Over::kPasses);
  for (size_t i = 0; i < runs[0]->end().layers.size(); ++i) {
    const std::string of_layer = "Error of " + runs[0]->end().layers[i].first;
    html += plot(of_layer + " over light paths", "light paths", Over::kEmitted, i) +
            plot(of_layer + " over time", "seconds", Over::kTime, i);
  }
  return html + "</div>\n";
}

std::string facts(const BenchScene& scene, const BenchSceneResult& result) {
  const BenchReferenceResult& r = result.reference;
  std::string text =
      fmt::format("{}, {} × {} pixels. Reference: ", scene.file, result.width, result.height);
  if (r.rendered)
    text += fmt::format("rendered with {}, {} in {}", r.integrator,
                        counted(r.passes, "pass", "passes"), seconds_in_words(r.seconds));
  else
    text += r.picture;
  if (r.own_error)
    text +=
        fmt::format("; its own RMS error, as it estimates it, is {}", number_text(*r.own_error));
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
  for (const BenchRun& run : result.runs) {
    if (!run.failure.empty()) failure(run.integrator + ": " + run.failure);
    for (const BenchRun& again : run.again)
      if (!again.failure.empty())
        failure(fmt::format("{}, seed {}: {}", run.integrator, again.seed, again.failure));
  }
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
    html += "<h3>Errors</h3>\n" + error_table(runs, result.reference.own_error) +
            parts_table("Regions", runs, region_errors) +
            parts_table("Layers", runs, layer_errors_at_end) + plots(results, runs) +
            "<h3>Work and memory</h3>\n" + work_table(runs) + energy_lines(result) + settings(runs);
  return html + "</section>\n";
}

}  // namespace nephroid
