// `nephroid convert`: writes a scene of any format as a pbrt-v4 scene.
#include <fmt/format.h>

#include <filesystem>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/counted.h"
#include "core/errors.h"
#include "input/convert/pbrt_writer.h"
#include "input/scene_reader.h"
#include "session/checkpoint/checkpoint.h"
#include "session/process_memory.h"

namespace nephroid {
namespace {

/// " and 3 files of meshes and images, vase-1.ply to vase-3.png" for vase.pbrt.
std::string beside_it(const std::vector<std::string>& files) {
  if (files.empty()) return "";
  const std::string count = counted(files.size(), "file");
  if (files.size() == 1)
    return fmt::format(" and {} of a mesh or image beside it, {}", count, files[0]);
  return fmt::format(" and {} of meshes and images beside it, {} to {}", count, files.front(),
                     files.back());
}

}  // namespace

int run_convert(const ConvertCommand& command) {
  std::error_code ignored;
  if (std::filesystem::equivalent(command.input, command.output, ignored))
    throw UsageError(fmt::format("OUT.pbrt: '{}' is the scene to convert, expected another name",
                                 command.output));
  MemoryLimit limit;
  limit.set(machine_memory());
  Diagnostics diagnostics;
  const SceneDescription scene = read_scene(command.input, command.import, diagnostics);
  for (const Warning& warning : diagnostics.warnings())
    print_warning(located(warning.where, warning.message));
  for (const Warning& note : diagnostics.notes()) print_notes({located(note.where, note.message)});
  if (std::filesystem::exists(command.output, ignored)) {
    // Somebody may have edited it.
    const std::string kept = kept_name(command.output);
    std::error_code error;
    std::filesystem::rename(command.output, kept, error);
    if (error)
      throw IoError(
          fmt::format("{}: cannot be kept as {}: {}", command.output, kept, error.message()));
    print_warning(fmt::format("{} is there already; it is kept as {}", command.output, kept));
  }
  const std::vector<std::string> files = write_pbrt(scene, command.output);
  fmt::print("wrote {}{}\n", command.output, beside_it(files));
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
