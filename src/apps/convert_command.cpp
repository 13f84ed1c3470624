// `nephroid convert`: writes a scene of any format as a pbrt-v4 scene.
#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/errors.h"
#include "input/convert/pbrt_writer.h"
#include "input/scene_reader.h"
#include "session/process_memory.h"

namespace nephroid {

int run_convert(const ConvertCommand& command) {
  MemoryLimit limit;
  limit.set(machine_memory());
  Diagnostics diagnostics;
  const SceneDescription scene = read_scene(command.input, command.import, diagnostics);
  for (const Warning& warning : diagnostics.warnings())
    print_warning(located(warning.where, warning.message));
  write_pbrt(scene, command.output);
  fmt::print("wrote {}\n", command.output);
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
