// An experiment in the report: its curves, the powers that are predicted, and a table of slopes.
#include <fmt/format.h>

#include <cmath>

#include "bench/html_text.h"
#include "bench/report.h"
#include "bench/svg_plot.h"

namespace nephroid {
namespace {

/// The predicted power through the curve's last point.
PlotSeries prediction(const ExperimentCurve& curve, size_t style) {
  PlotSeries series{curve.name + ", predicted", style, {}, true};
  const CurvePoint& first = curve.points.front();
  const CurvePoint& last = curve.points.back();
  series.points = {{first.x, last.y * std::pow(first.x / last.x, curve.predicted)}, last};
  return series;
}

std::string part_html(const ExperimentPart& part) {
  std::string legend = "<div class=\"legend\">";
  std::vector<PlotSeries> series;
  ReportTable slopes;
  slopes.head = {"slope of the error", "fitted", "predicted"};
  for (size_t i = 0; i < part.curves.size(); ++i) {
    const ExperimentCurve& curve = part.curves[i];
    series.push_back({curve.name, i, curve.points});
    series.push_back(prediction(curve, i));
    legend += "<span>" + svg_line_sample(i) + html_escape(curve.name) + "</span>";
    slopes.rows.push_back({{html_escape(curve.name), false},
                           {number_text(curve.slope), false},
                           {number_text(curve.predicted), false}});
  }
  return fmt::format("<div><h3>{}</h3><p>{}</p>{}</div>{}{}</div>\n", html_escape(part.title),
                     html_escape(part.text), legend,
                     svg_log_plot(part.title + " over passes", "passes", "error", series),
                     slopes.html());
}

}  // namespace

std::string report_of_experiment(const BenchExperiment& experiment) {
  std::string html = fmt::format(
      "<section><h2 id=\"experiment-{}\">{}</h2>\n<p>{} Dashed lines have the "
      "predicted power.</p>\n<div class=\"plots\">",
      experiment.name, html_escape(experiment.title), html_escape(experiment.text));
  for (const ExperimentPart& part : experiment.parts) html += part_html(part);
  return html + "</div></section>\n";
}

}  // namespace nephroid
