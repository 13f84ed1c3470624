#include "integrator/metropolis/metropolis_options.h"

#include <fmt/format.h>

#include <limits>

#include "input/option_values.h"

namespace nephroid {

const EstimatorSetting kMutationsSetting = {
    "mutations",
    "X",
    "0",
    "mutations",
    "Mutations per pixel and pass. 0 chooses.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<MetropolisOptions>().mutations =
          parse_float("-D mutations", text, 0, std::numeric_limits<float>::max(), false);
    },
    [](const IntegratorOptions& options) {
      return fmt::format("{}", options.own<MetropolisOptions>().mutations);
    }};

const EstimatorSetting kChainLengthSetting = {
    "chain-length",
    "N",
    "0",
    "mutations",
    "Mutations after which a Markov chain gives way to a new one. 0 chooses.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<MetropolisOptions>().chain_length = parse_integer("-D chain-length", text, 0);
    },
    [](const IntegratorOptions& options) {
      return fmt::format("{}", options.own<MetropolisOptions>().chain_length);
    }};

const EstimatorSetting kLargeStepSetting = {
    "large-step",
    "X",
    "0.1",
    "",
    "Probability of a large step, which forgets the current path. Above 0 to 1.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<MetropolisOptions>().large_step = parse_float("-D large-step", text, 0, 1, true);
    },
    [](const IntegratorOptions& options) {
      return fmt::format("{}", options.own<MetropolisOptions>().large_step);
    }};

}  // namespace nephroid
