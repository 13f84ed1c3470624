#include "apps/render_request.h"

#include <filesystem>

namespace nephroid {

RenderRequest request_of(const RenderCommand& command) {
  RenderRequest request;
  request.scene = command.scene;
  request.overrides = command.overrides;
  request.routes = command.routes;
  request.settings = render_settings(command.settings, command.memory);
  request.reject_outliers = command.reject_outliers;
  request.memory = command.memory;
  request.seed = command.seed;
  request.resume = command.resume;
  request.learned_from = command.learned_from;
  request.strict = command.strict;
  RenderOptions& options = request.options;
  if (command.passes) {
    options.first_pass = command.passes->first;
    options.last_pass = command.passes->second;
  }
  options.time_limit = command.time_limit;
  options.noise_target = command.noise_target;
  options.output = command.output;
  options.checkpoint_interval = command.checkpoint_interval;
  options.keeps_state = command.keeps_state;
  options.layer_precision = command.layer_precision;
  std::error_code no_temporary_directory;
  options.rescue_directory = std::filesystem::temp_directory_path(no_temporary_directory).string();
  return request;
}

}  // namespace nephroid
