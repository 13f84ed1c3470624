// Results kept from earlier invocations: files whose names have a hash of everything that
// determines them. It must not know how they are made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bench/render.h"

namespace nephroid {

/// 16 digits that change with the text.
std::string hash_text(const std::string& text);

/// Hash of a picture's window, channels, colour space and pixels, without its metadata; 16 digits.
std::string hash_picture(const Picture& picture);

/// Hash of everything that determines a rendered reference: the scene (SceneFiles::hash), settings,
/// routes and version.
std::string reference_key(const BenchRender& render, uint64_t scene_hash);
/// Hash of everything that determines a run and its figures: the same, plus the reference's picture
/// (its hash_picture), the program itself, the instruction set and the number of threads.
std::string run_key(const BenchRender& render, uint64_t scene_hash,
                    const std::string& reference_hash);

/// DIRECTORY/FOLDER/NAME-KEY, without an extension. Creates the folder; throws IoError if it
/// cannot.
std::string kept_stem(const std::string& directory, const std::string& folder,
                      const std::string& name, const std::string& key);

/// The files of one result.
struct KeptFiles {
  std::string json, picture;
};
/// The files of the result with this name and key.
KeptFiles kept_files(const std::string& directory, const std::string& folder,
                     const std::string& name, const std::string& key);

/// The text of a file; empty if it cannot be read.
std::optional<std::string> text_of_file(const std::string& file);
/// Writes a file atomically. Throws IoError.
void write_text(const std::string& file, const std::string& text);

}  // namespace nephroid
