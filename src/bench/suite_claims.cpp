#include "bench/suite_claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "bench/suite_fields.h"

namespace nephroid {
namespace {

struct MetricRow {
  BenchMetric metric;
  const char *name, *title;
};
constexpr MetricRow kMetrics[] = {
    {BenchMetric::kRmse, "rmse", "RMSE"},
    {BenchMetric::kRelmse, "relmse", "relMSE"},
    {BenchMetric::kRelmseTrim, "relmse_trim", "trimmed relMSE"},
    {BenchMetric::kFlip, "flip", "FLIP"},
    {BenchMetric::kMeanError, "mean_error", "relative error of the mean"},
    {BenchMetric::kMemory, "memory", "memory"},
    {BenchMetric::kPhotonMemory, "photon_memory", "photon memory"},
    {BenchMetric::kPixelMemory, "pixel_memory", "memory of pixels"},
    {BenchMetric::kMemoryGrowth, "memory_growth", "growth of memory"},
    {BenchMetric::kPhotons, "photons", "photons stored"},
    {BenchMetric::kEmitted, "emitted", "light paths"},
    {BenchMetric::kRays, "rays", "rays"},
    {BenchMetric::kPasses, "passes", "passes"},
    {BenchMetric::kSeconds, "seconds", "seconds"},
    {BenchMetric::kSlope, "slope", "slope of RMSE"},
};

struct AxisRow {
  BenchAxis axis;
  const char* name;
};
constexpr AxisRow kAxes[] = {
    {BenchAxis::kPasses, "passes"}, {BenchAxis::kTime, "time"}, {BenchAxis::kEmitted, "emitted"}};

/// The row named by the value.
template <class Row, size_t kCount>
const Row& row_of(const Row (&rows)[kCount], const JsonValue& value, const std::string& what) {
  const std::string& name = text_of(value, what);
  std::vector<const char*> known;
  for (const Row& row : rows) {
    if (name == row.name) return row;
    known.push_back(row.name);
  }
  value.fail(
      fmt::format("unknown {} \"{}\", expected one of: {}", what, name, fmt::join(known, ", ")));
}

void check_integrator(const BenchSuite& suite, const std::string& name, const JsonValue& value) {
  if (suite.find_integrator(name) == nullptr)
    value.fail(fmt::format("unknown integrator \"{}\", expected one of the suite's", name));
}

template <class Named>
bool has(const std::vector<Named>& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const Named& n) { return n.name == name; });
}

bool runs(const BenchScene& scene, const std::string& integrator) {
  return std::find(scene.integrators.begin(), scene.integrators.end(), integrator) !=
         scene.integrators.end();
}

/// Reads subject, others and numbers, by the keys of the claim's form.
void read_form(const Fields& fields, BenchClaim* claim) {
  const int forms = int{fields.has("smaller")} + int{fields.has("same")} + int{fields.has("of")};
  if (forms != 1)
    fields.value().fail(
        "a claim needs exactly one of \"smaller\" (with \"than\"), \"same\" (with \"as\") and "
        "\"of\" (with \"between\")");
  if (fields.has("of")) {
    claim->form = BenchClaim::Form::kBetween;
    claim->subject = fields.text("of");
    const JsonValue between = fields.required("between");
    expect_type(between, Json::value_t::array, "\"between\"");
    const std::vector<JsonValue> ends = between.items();
    if (ends.size() != 2) between.fail("\"between\" is not valid, expected [low, high]");
    constexpr double kAny = std::numeric_limits<double>::infinity();
    claim->low = number_of(ends[0], "\"between\"", -kAny, kAny);
    claim->high = number_of(ends[1], "\"between\"", claim->low, kAny);
    return;
  }
  const bool smaller = fields.has("smaller");
  claim->form = smaller ? BenchClaim::Form::kSmaller : BenchClaim::Form::kSame;
  claim->subject = fields.text(smaller ? "smaller" : "same");
  fields.required(smaller ? "than" : "as");
  claim->others = fields.texts(smaller ? "than" : "as");
  claim->factor = fields.number_or("factor", 1, smaller ? 0 : 1, 1e12);
}

std::vector<std::string> keys_for(const Fields& fields) {
  std::vector<std::string> keys = {"text", "metric", "scenes", "region", "layer", "over", "at"};
  const auto add = [&](std::initializer_list<const char*> more) {
    keys.insert(keys.end(), more.begin(), more.end());
  };
  if (fields.has("smaller")) add({"smaller", "than", "factor"});
  if (fields.has("same")) add({"same", "as", "factor"});
  if (fields.has("of")) add({"of", "between"});
  return keys;
}

/// Checks that the parts of a claim are consistent.
void check_claim(const Fields& fields, const BenchSuite& suite, const BenchClaim& claim) {
  for (const char* key : {"smaller", "same", "of", "than", "as"}) {
    const std::optional<JsonValue> value = fields.find(key);
    if (!value) continue;
    if (value->json().is_string()) check_integrator(suite, text_of(*value, key), *value);
    for (const JsonValue& item : value->items()) check_integrator(suite, text_of(item, key), item);
  }
  if (!claim.region.empty() && (!is_error(claim.metric) || claim.at_equal))
    fields.required("region").fail(
        "\"region\" does not fit this claim, expected it only with the metric of an error and "
        "without \"at\"");
  if (!claim.layer.empty() &&
      ((!is_error(claim.metric) && claim.metric != BenchMetric::kSlope) || !claim.region.empty()))
    fields.required("layer").fail(
        "\"layer\" does not fit this claim, expected it only with the metric of an error or a "
        "slope and without \"region\"");
  if (fields.has("over") && claim.metric != BenchMetric::kSlope)
    fields.required("over").fail(
        "\"over\" does not fit this claim, expected it only with the metric \"slope\"");
  // Slopes are negative, so a factor would reverse the claim.
  if (claim.metric == BenchMetric::kSlope && claim.form != BenchClaim::Form::kBetween)
    fields.required("metric").fail(
        "the metric \"slope\" cannot be compared, expected \"of\" and \"between\" with it");
  if (claim.at_equal && (!is_error(claim.metric) || claim.form == BenchClaim::Form::kBetween))
    fields.required("at").fail(
        "\"at\" does not fit this claim, expected it only with the metric of an error and with "
        "\"smaller\" or \"same\"");
  for (const JsonValue& item : fields.list("scenes")) {
    const std::string& name = text_of(item, "a scene");
    const BenchScene* scene = suite.find_scene(name);
    if (scene == nullptr)
      item.fail(fmt::format("unknown scene \"{}\", expected one of the suite's", name));
    std::vector<std::string> needed = claim.others;
    needed.push_back(claim.subject);
    for (const std::string& integrator : needed)
      if (!runs(*scene, integrator))
        item.fail(
            fmt::format("scene \"{}\" has no integrator \"{}\", expected a scene with all "
                        "integrators of the claim",
                        name, integrator));
    if (!claim.region.empty() && !has(scene->regions, claim.region))
      item.fail(fmt::format("scene \"{}\" has no region \"{}\", expected a scene that has it", name,
                            claim.region));
    if (!claim.layer.empty() && !has(scene->layers, claim.layer))
      item.fail(fmt::format("scene \"{}\" has no layer \"{}\", expected a scene that has it", name,
                            claim.layer));
  }
}

}  // namespace

const char* metric_title(BenchMetric metric) {
  return std::find_if(std::begin(kMetrics), std::end(kMetrics),
                      [&](const MetricRow& row) { return row.metric == metric; })
      ->title;
}

const char* axis_name(BenchAxis axis) {
  return std::find_if(std::begin(kAxes), std::end(kAxes),
                      [&](const AxisRow& row) { return row.axis == axis; })
      ->name;
}

BenchClaim parse_claim(const JsonValue& value, const BenchSuite& suite) {
  const Fields any(value, "a claim",
                   {"text", "metric", "scenes", "region", "layer", "over", "at", "smaller", "than",
                    "factor", "same", "as", "of", "between"});
  BenchClaim claim;
  read_form(any, &claim);
  const Fields fields(value, "a claim of this form", keys_for(any));
  claim.text = fields.text("text");
  claim.metric = row_of(kMetrics, fields.required("metric"), "metric").metric;
  claim.region = fields.text_or("region", "");
  claim.layer = fields.text_or("layer", "");
  for (const JsonValue& item : fields.list("scenes"))
    claim.scenes.push_back(text_of(item, "an item of \"scenes\""));
  if (const std::optional<JsonValue> over = fields.find("over"))
    claim.over = row_of(kAxes, *over, "axis").axis;
  if (const std::optional<JsonValue> at = fields.find("at"))
    claim.at_equal = row_of(kAxes, *at, "axis").axis;
  check_claim(fields, suite, claim);
  return claim;
}

}  // namespace nephroid
