#include "integrator/path/path_options.h"

#include "input/option_values.h"

namespace nephroid {

const EstimatorSetting kSpecularTreesSetting = {
    "specular-trees",
    "yes|no",
    "no",
    "",
    "Camera walks follow both ways at smooth glass to lights behind it. Worth it where small lamps "
    "show in much glass; `mixed` does it by itself where it pays.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<PathOptions>().specular_trees = parse_yes_no("-D specular-trees", text);
    },
    [](const IntegratorOptions& options) {
      return yes_no_text(options.own<PathOptions>().specular_trees);
    }};

}  // namespace nephroid
