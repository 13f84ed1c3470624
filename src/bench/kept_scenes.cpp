#include "bench/kept_scenes.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <sstream>

#include "bench/kept.h"
#include "core/errors.h"

namespace nephroid {
namespace {

/// The hash of all files, then a line for each file. A name with a line break is not found again,
/// so its list is invalid.
std::string list_text(const SceneFiles& files) {
  std::string text = fmt::format("{:016x}\n", files.hash());
  for (const std::string& name : files.names()) text += name + "\n";
  return text;
}

/// The hash of a list, if its files still have it.
std::optional<uint64_t> hash_that_holds(const std::string& list, const std::string& top) {
  SceneFiles files(std::filesystem::path(top).parent_path().string());
  files.set_top(top);
  std::istringstream lines(list);
  std::string hash, name;
  std::getline(lines, hash);
  try {
    files.read(top);
    while (std::getline(lines, name)) {
      // Compressed files count unpacked. Pipes are not read, since reading could block.
      const std::string path = files.counted_path_of(name);
      if (std::filesystem::is_regular_file(path)) files.read(path);
    }
  } catch (const std::exception&) {  // a file is missing, or no longer a file
    return std::nullopt;
  }
  if (fmt::format("{:016x}", files.hash()) != hash) return std::nullopt;
  return files.hash();
}

}  // namespace

uint64_t KeptScenes::hash(const std::string& file, const std::function<const SceneFiles&()>& load) {
  const auto known = known_.find(file);
  if (known != known_.end()) return known->second;
  return known_[file] = find_hash(file, load);
}

uint64_t KeptScenes::find_hash(const std::string& file,
                               const std::function<const SceneFiles&()>& load) const {
  const std::string name = std::filesystem::path(file).stem().string();
  const std::string list =
      kept_stem(directory_, "scenes", name, hash_text(std::filesystem::absolute(file).string())) +
      ".txt";
  if (const auto text = text_of_file(list))
    if (const auto hash = hash_that_holds(*text, file)) return *hash;
  const SceneFiles& files = load();
  write_text(list, list_text(files));
  return files.hash();
}

}  // namespace nephroid
