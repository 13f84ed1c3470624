#include "input/scene_files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "core/content_hash.h"
#include "core/errors.h"
#include "input/file_bytes.h"

namespace nephroid {

SceneFiles::SceneFiles(std::string directory)
    : directory_(directory.empty() ? "." : std::move(directory)) {}

std::string SceneFiles::path_of(const std::string& name) const {
  const std::filesystem::path path(name);
  // In the current directory the scene's own spelling is kept.
  if (path.is_absolute() || directory_ == ".") return name;
  return (std::filesystem::path(directory_) / path).string();
}

void SceneFiles::note(const std::string& path) {
  if ((path == kStandardInput && path == top_) || is_stream(path)) return;
  const FileStamp stamp = stamp_of(path);
  const std::lock_guard lock(mutex_);
  stamps_.try_emplace(path, stamp);
}

FileStamps SceneFiles::stamps() const {
  const std::lock_guard lock(mutex_);
  return stamps_;
}

std::string SceneFiles::read(const std::string& path) {
  note(path);
  try {
    std::string bytes =
        path == kStandardInput && path == top_ ? read_standard_input() : read_file_bytes(path);
    const uint64_t hash = hash_of(std::as_bytes(std::span(bytes)));
    const std::lock_guard lock(mutex_);
    read_[counted_name(path)] = hash;
    return bytes;
  } catch (const std::bad_alloc&) {
    throw IoError("cannot read \"" + path + "\": it does not fit into memory");
  }
}

std::string SceneFiles::counted_path_of(const std::string& name) {
  const std::string path = path_of(name);
  const std::string counted = counted_name(path);
  {
    const std::lock_guard lock(mutex_);
    if (read_.contains(counted)) return path;
  }
  note(path);
  try {
    const uint64_t hash = hash_file(path);
    const std::lock_guard lock(mutex_);
    read_[counted] = hash;
  } catch (const IoError&) {  // reported by the reader of the file
  }
  return path;
}

FileSource SceneFiles::source_of(const std::string& name) {
  if (std::shared_ptr<const std::string> bytes = in_memory(name)) return {name, std::move(bytes)};
  return counted_path_of(name);
}

void SceneFiles::add_in_memory(const std::string& name, std::string bytes) {
  const std::lock_guard lock(mutex_);
  in_memory_[name] = std::make_shared<const std::string>(std::move(bytes));
}

std::shared_ptr<const std::string> SceneFiles::in_memory(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = in_memory_.find(name);
  return found == in_memory_.end() ? nullptr : found->second;
}

uint64_t SceneFiles::hash() const {
  const std::lock_guard lock(mutex_);
  ContentHash all;
  for (const auto& [name, hash] : read_) {
    all.add(std::as_bytes(std::span(name)));
    all.add(std::as_bytes(std::span(&hash, 1)));
  }
  return all.value();
}

std::vector<std::string> SceneFiles::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& entry : read_)
    if (!entry.first.empty()) names.push_back(entry.first);
  return names;
}

std::string SceneFiles::counted_name(const std::string& path) const {
  if (path == top_) return "";
  const auto absolute = [](const std::string& name) {
    std::error_code error;
    const std::filesystem::path result = std::filesystem::absolute(name, error);
    return (error ? std::filesystem::path(name) : result).lexically_normal();
  };
  // The same name for all spellings of a path.
  return absolute(path).lexically_relative(absolute(directory_)).string();
}

std::string directory_of_scene(const std::string& scene) {
  const std::string parent = std::filesystem::path(scene).parent_path().string();
  // /dev/stdin may be a file.
  const bool is_device = parent == "/dev" || parent == "/dev/fd" || parent == "/proc/self/fd";
  return scene == kStandardInput || is_device || is_stream(scene) ? "." : parent;
}

std::shared_ptr<SceneFiles> files_of_scene(const std::string& scene) {
  auto files = std::make_shared<SceneFiles>(directory_of_scene(scene));
  files->set_top(scene);
  return files;
}

uint64_t hash_file(const std::string& path) {
  ContentHash hash;
  if (is_stream(path)) return hash.value();
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path + ": cannot read: " + std::strerror(errno));
  std::vector<char> block(1 << 16);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(std::as_bytes(std::span(block).first(file.gcount())));
  }
  if (file.bad()) throw IoError(path + ": cannot read: " + std::strerror(errno));
  return hash.value();
}

}  // namespace nephroid
