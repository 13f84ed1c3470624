// `nephroid merge`: adds up pictures of disjoint passes.
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/counted.h"
#include "core/errors.h"
#include "film/film_output.h"
#include "film/state_file.h"
#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/merge_pictures.h"

namespace nephroid {

int run_merge(const MergeCommand& command) {
  if (command.output.empty())
    throw UsageError("merge: no --output given, expected a name that ends in .exr");
  check_picture_can_be_written(command.output);
  const Merged merged = merge_pictures(command.inputs, command.output, command.layer_precision);
  for (const std::string& warning : merged.warnings) print_warning(warning);
  fmt::print("{} ({}), rendered in {:.1f} s; wrote {}, {} and {}\n",
             counted(merged.passes.count(), "pass", "passes"), merged.passes.text(), merged.seconds,
             command.output, png_path_beside(command.output), state_path_beside(command.output));
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
