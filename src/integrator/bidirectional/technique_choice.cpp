#include "integrator/bidirectional/technique_choice.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "input/option_values.h"

namespace nephroid {
namespace {

/// "all", "merged" or "S,T", and then perhaps ",raw".
TechniqueChoice parse_technique(const std::string& text) {
  constexpr std::string_view kRaw = ",raw";
  TechniqueChoice choice;
  std::string which = text;
  if (which.ends_with(kRaw)) {
    choice.weighted = false;
    which.resize(which.size() - kRaw.size());
  }
  choice.connects = which != "merged";
  if (which == "all" || which == "merged") return choice;
  const size_t comma = which.find(',');
  if (comma == std::string::npos)
    throw UsageError(
        fmt::format("-D technique: '{}' is not valid, expected all, merged or S,T (such as 1,3), "
                    "optionally followed by ,raw",
                    text));
  const auto count = [](const std::string& t, int low) {
    return t == "*" ? -1 : parse_int("-D technique", t, low);
  };
  choice.s = count(which.substr(0, comma), 0);
  choice.t = count(which.substr(comma + 1), 1);
  return choice;
}
std::string technique_text(const TechniqueChoice& choice) {
  const auto count = [](int n) { return n < 0 ? std::string("*") : std::to_string(n); };
  const std::string which = !choice.connects  ? "merged"
                            : choice.merges() ? "all"
                                              : count(choice.s) + "," + count(choice.t);
  return which + (choice.weighted ? "" : ",raw");
}

}  // namespace

const EstimatorSetting kTechniqueSetting = {
    "technique",
    "S,T",
    "all",
    "",
    "One technique alone. S vertices from the light, its start included, and T from the eye, the "
    "lens included (* for any number), or merged; with ,raw behind it without weights, as if there "
    "were no other technique.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<TechniqueChoice>() = parse_technique(text);
    },
    [](const IntegratorOptions& options) {
      return technique_text(options.own<TechniqueChoice>());
    }};

}  // namespace nephroid
