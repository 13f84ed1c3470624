// The types of samplers; see sampler_description.h.
#include "scene/sampler_description.h"

#include <limits>

#include "input/spelling.h"

namespace nephroid {
namespace {

constexpr const char* kOwnPoints = "the points are the program's own";

constexpr FormatParameter kPixelSamples[] = {{"integer", "pixelsamples", "16", "samples"}};
constexpr FormatParameter kFewPixelSamples[] = {{"integer", "pixelsamples", "4", "samples"}};
constexpr FormatParameter kSeed[] = {{"integer", "seed", "Option \"seed\""}};
constexpr FormatParameter kPermuteDigits[] = {
    {"string", "randomization", "permutedigits", "", kOwnPoints, Support::kNotNeeded}};
constexpr FormatParameter kFastOwen[] = {
    {"string", "randomization", "fastowen", "", kOwnPoints, Support::kNotNeeded}};
constexpr FormatParameter kStratified[] = {
    {"integer", "xsamples", "4", "samples"},
    {"integer", "ysamples", "4", "samples", "times xsamples"},
    {"bool", "jitter", "true", "", kOwnPoints, Support::kNotNeeded},
};

constexpr FormatType kSamplerTable[] = {
    {"halton", {kPixelSamples, kPermuteDigits, kSeed}},
    {"independent", {kFewPixelSamples, kSeed}},
    {"paddedsobol", {kPixelSamples, kFastOwen, kSeed}},
    {"pmj02bn", {kPixelSamples, kSeed}},
    {"sobol", {kPixelSamples, kFastOwen, kSeed}},
    {"stratified", {kStratified, kSeed}},
    {"zsobol", {kPixelSamples, kFastOwen, kSeed}, "the default"},
};

}  // namespace

std::vector<FormatType> sampler_types() {
  return format_types(kSamplerTable);
}

SamplerDescription read_sampler(const std::optional<DirectiveDescription>& sampler, int seed,
                                Diagnostics& diagnostics) {
  SamplerDescription result;
  result.seed = seed;
  if (!sampler) return result;
  const ParameterSet& p = sampler->parameters;
  const std::string& type = sampler->type;
  const FormatType* row = find_row(kSamplerTable, type);
  if (!row) {
    std::vector<std::string> names;
    for (const FormatType& known : kSamplerTable) names.emplace_back(known.name);
    const std::string meant = did_you_mean(type, names);
    diagnostics.warn_of_unknown_name(
        p.where, "unknown sampler \"" + type + "\"" +
                     (meant.empty() ? ", only its number of samples is taken" : meant));
    row = find_row(kSamplerTable, "zsobol");
  }
  const bool stratified = type == "stratified";
  const int64_t x = stratified ? p.get_int("xsamples", 4)
                               : p.get_int("pixelsamples", type == "independent" ? 4 : 16);
  const int64_t y = stratified ? p.get_int("ysamples", 4) : 1;
  if (x < 1 || y < 1 || x * y > std::numeric_limits<int>::max())
    throw SceneError(p.where, "the number of pixel samples must be at least 1 and fit 32 bits");
  result.samples_per_pixel = static_cast<int>(x * y);
  result.seed = p.get_int("seed", seed);
  p.report_unused("sampler \"" + type + "\"", *row, diagnostics);
  return result;
}

}  // namespace nephroid
