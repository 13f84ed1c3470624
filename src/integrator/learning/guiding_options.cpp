#include "integrator/learning/guiding_options.h"

#include "input/option_values.h"

namespace nephroid {

const EstimatorSetting kGuideSetting = {
    "guide",
    "yes|no",
    "yes",
    "",
    "Photons start, and with `photons` leave rough surfaces, in directions that were useful to "
    "earlier ones.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<GuidingOptions>().photons = parse_yes_no("-D guide", text);
    },
    [](const IntegratorOptions& options) {
      return yes_no_text(options.own<GuidingOptions>().photons);
    }};

const EstimatorSetting kGuideWalksSetting = {
    "guide-walks",
    "yes|no",
    "yes",
    "",
    "Camera walks prefer directions in which light was found, where that pays.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<GuidingOptions>().walks = parse_yes_no("-D guide-walks", text);
    },
    [](const IntegratorOptions& options) {
      return yes_no_text(options.own<GuidingOptions>().walks);
    }};

}  // namespace nephroid
