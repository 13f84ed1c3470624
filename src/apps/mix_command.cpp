// `nephroid mix`: adds up the layers of a picture with other gains.
#include <fmt/format.h>

#include <filesystem>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/errors.h"
#include "film/film_output.h"
#include "image/mix.h"
#include "session/checkpoint/checkpoint.h"

namespace nephroid {
namespace {

/// Throws UsageError for arguments that are missing or contradict each other.
void check(const MixCommand& command) {
  if (command.output.empty())
    throw UsageError("mix: no --output given, expected a name that ends in .exr");
  if (command.mix.empty())
    throw UsageError("mix: neither --light nor --route given, expected a gain as in --light key=2");
  std::error_code missing;
  if (std::filesystem::equivalent(command.picture, command.output, missing))
    throw UsageError("--output: '" + command.output +
                     "' is the picture to mix, expected another name");
}

void print_warnings_of(const std::string& picture, const Metadata& metadata) {
  for (const std::string& reason : inexact_mix_reasons(metadata))
    print_warning(picture + ": the mix is not quite what a render would be: " + reason);
}

void print_notes_of(const Mix& mix) {
  for (const auto* gains : {&mix.lights, &mix.routes})
    for (const MixGain& gain : *gains)
      if (gain.is_tint())
        fmt::print("note: the tint of '{}' is an approximation: light is rendered in spectra\n",
                   gain.name);
}

Picture mixed_picture(const std::string& path, const Picture& picture, const Mix& mix) try {
  return mixed(picture, mix);
} catch (const UsageError& error) {
  throw UsageError(path + ": " + error.what());
}

}  // namespace

int run_mix(const MixCommand& command) {
  check(command);
  check_picture_can_be_written(command.output);
  const Picture picture = read_picture(command.picture);
  const Picture result = mixed_picture(command.picture, picture, command.mix);
  print_warnings_of(command.picture, picture.metadata);
  print_notes_of(command.mix);
  if (const auto warning = warning_of_replacing(command.output, RenderIdentity()))
    print_warning(*warning);
  keep_files(command.output);
  write_picture(command.output, result, 1, command.layer_precision);
  fmt::print("wrote {} and {}\n", command.output, png_path_beside(command.output));
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
