// NanoVDB files and the media made of them; see targets.h.
#include <cstring>

#include "fuzz/disk_file.h"
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/pbrt_parser.h"
#include "scene/medium/medium.h"
#include "unit/medium/nanovdb_writer.h"

namespace nephroid::fuzz {
namespace {

constexpr size_t kPatchBytes = 8;

/// A valid file with two grids, written by the library. At half a megabyte, no fuzzer would make
/// one.
const std::string& sound_file() {
  static const std::string bytes = [] {
    const DiskFile file("", ".nvdb");
    const auto value = [](int x, int y, int z) { return static_cast<float>(1 + x + y + z); };
    testing_medium::write_nanovdb(file.path(), {{"density", {0, 0, 0}, {5, 4, 3}, value},
                                                {"temperature", {0, 0, 0}, {1, 1, 1}, value}});
    return SceneFiles().read(file.path());
  }();
  return bytes;
}

/// Input that begins as a NanoVDB file is used as it is. Other input is a list of changes to a
/// valid file: four bytes of offset, four bytes of new data.
std::string file_of(const std::string& bytes) {
  if (bytes.starts_with("NanoVDB")) return bytes;
  std::string file = sound_file();
  for (size_t i = 0; i + kPatchBytes <= bytes.size(); i += kPatchBytes) {
    uint32_t at;
    std::memcpy(&at, bytes.data() + i, 4);
    std::memcpy(file.data() + at % (file.size() - 4), bytes.data() + i + 4, 4);
  }
  return file;
}

void use(const Medium& medium) {
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.4f);
  bool good = true;
  for (const Vec3f& p : {Vec3f(0, 0, 0), Vec3f(2.2f, 1.7f, 0.4f), Vec3f(-1e9f, 3, 1e30f)}) {
    const MediumProperties m = medium.at(p, lambda);
    good = good && m.sigma_a.is_finite() && m.sigma_s.is_finite() && m.le.is_finite() &&
           (m.sigma_s * -1.0f).max_component() <= 0;
  }
  for (const Vec3f& d : {Vec3f(0, 0, 1), Vec3f(0.6f, 0, 0.8f)}) {
    Ray ray;
    ray.o = Vec3f(0.5f, 0.5f, -10);
    ray.d = d;
    MajorantIterator i = medium.majorants(ray, 1e6f, lambda);
    int segments = 0;
    while (const auto segment = i.next())
      if (!segment->sigma_maj.is_finite() || ++segments > 1000) good = false;
  }
  if (!good) __builtin_trap();
}

}  // namespace

void nanovdb(const std::string& bytes) {
  const MemoryFiles files({{"f.nvdb", file_of(bytes)}});
  Diagnostics diagnostics;
  try {
    const SceneDescription description = parse_pbrt_string(
        "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"f.nvdb\" "
        "WorldBegin",
        "fuzz.pbrt", ".", diagnostics);
    for (const MediumPtr& medium : make_media(description, diagnostics)) use(*medium);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
