#include "input/convert/companion_files.h"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "input/convert/ply_writer.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

struct Mark {
  std::string_view first_bytes;
  const char* suffix;
};
constexpr Mark kImages[] = {
    {"\x89PNG", ".png"},    {"\xff\xd8\xff", ".jpg"},     {"RIFF", ".webp"},    {"PF", ".pfm"},
    {"#?RADIANCE", ".hdr"}, {"\x76\x2f\x31\x01", ".exr"}, {"\xabKTX", ".ktx2"},
};

/// The end of an image file's name, by its first bytes.
std::string suffix_of(const std::string& bytes) {
  for (const Mark& mark : kImages)
    if (bytes.starts_with(mark.first_bytes)) return mark.suffix;
  return ".bin";
}

std::string directory_of(const std::string& path) {
  const std::string parent = fs::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

/// True if the file has exactly these bytes.
bool has_bytes(const std::string& path, const std::string& bytes) {
  std::error_code error;
  if (fs::file_size(path, error) != bytes.size() || error) return false;
  std::ifstream file(path, std::ios::binary);
  std::string found(bytes.size(), '\0');
  return file.read(found.data(), static_cast<std::streamsize>(found.size())) && found == bytes;
}

}  // namespace

CompanionFiles::CompanionFiles(const SceneDescription& scene, const std::string& scene_file)
    : files_(*scene.files),
      directory_(directory_of(scene_file)),
      stem_(fs::path(scene_file).stem().string()) {}

std::string CompanionFiles::add(const std::string& bytes, const std::string& suffix) {
  for (;;) {
    const std::string name = fmt::format("{}-{}{}", stem_, ++last_number_, suffix);
    const std::string path = (fs::path(directory_) / name).string();
    std::error_code error;
    if (!fs::exists(path, error))
      write_bytes(path, bytes);
    else if (!has_bytes(path, bytes))
      continue;
    return names_.emplace_back(name);
  }
}

std::string CompanionFiles::add_mesh(const MeshData& mesh) {
  return add(ply_bytes(mesh), ".ply");
}

std::string CompanionFiles::name_of(const std::string& old_name) {
  if (const std::shared_ptr<const std::string> bytes = files_.in_memory(old_name)) {
    std::string& name = written_[old_name];
    if (name.empty()) name = add(*bytes, suffix_of(*bytes));
    return name;
  }
  if (fs::path(old_name).is_absolute()) return old_name;
  std::error_code error;
  const fs::path relative =
      fs::proximate(fs::absolute(files_.path_of(old_name)), fs::absolute(directory_), error);
  return error ? fs::absolute(files_.path_of(old_name)).string() : relative.string();
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    throw IoError("cannot write \"" + path + "\": " + std::generic_category().message(errno));
}

}  // namespace nephroid
