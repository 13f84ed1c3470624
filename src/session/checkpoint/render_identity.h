// Which render a picture is of, as its metadata tell it, and the names of all metadata that the
// program writes. It must not know how far a render has come: that is in checkpoint.h.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "film/film.h"
#include "film/image_io.h"

namespace nephroid {

/// What the names of all metadata of the program begin with.
inline constexpr std::string_view kKeyPrefix = "nephroid:";

// Of the render: the members of RenderIdentity.
inline constexpr const char* kVersionKey = "nephroid:version";
inline constexpr const char* kInstructionSetKey = "nephroid:instruction_set";
inline constexpr const char* kSceneKey = "nephroid:scene";
inline constexpr const char* kSceneHashKey = "nephroid:scene_hash";
inline constexpr const char* kIntegratorKey = "nephroid:integrator";
inline constexpr const char* kFilmKey = "nephroid:film";
inline constexpr const char* kRoutesKey = "nephroid:routes";
inline constexpr const char* kAovsKey = "nephroid:aovs";
inline constexpr const char* kOptionsKey = "nephroid:options";
inline constexpr const char* kOutliersKey = "nephroid:outliers";
inline constexpr const char* kSeedKey = "nephroid:seed";
// Of the film, for the program alone (film_metadata.h).
inline constexpr const char* kLayoutKey = "nephroid:layout";
// Of the progress (checkpoint.h).
inline constexpr const char* kPassesKey = "nephroid:passes";
inline constexpr const char* kOpenPassKey = "nephroid:unfinished_pass";
inline constexpr const char* kSecondsKey = "nephroid:seconds";
inline constexpr const char* kHistoryKey = "nephroid:history";
inline constexpr const char* kChoicesKey = "nephroid:choices";
inline constexpr const char* kOutlierEstimatesKey = "nephroid:outlier_estimates";
inline constexpr const char* kEstimatesKey = "nephroid:estimates:";  ///< and the name of a route

/// A render, in the words of its picture's metadata; empty members are not in the picture.
struct RenderIdentity {
  std::string version;     ///< program version
  std::string scene_hash;  ///< hash of all files of the scene
  std::string film;        ///< resolution and crop window
  std::string routes;      ///< one route a line, in the order that decides who owns a path
  std::string aovs;        ///< one AOV a line
  std::string options;     ///< "key=value" of every -D key, separated by spaces
  std::string outliers;    ///< "reject" if the film rejects outliers
  std::string seed;

  // Told, but two pictures of the same render may differ in them.
  std::string scene;             ///< file name
  std::string integrator;        ///< integrator, preset or file of the routes
  std::string instruction_sets;  ///< instruction sets of all runs (version.h), separated by "; "

  /// Version and instruction set of this program, all else empty.
  static RenderIdentity of_this_program();
  /// The identity that a picture tells.
  static RenderIdentity from_metadata(const Metadata& metadata);
  Metadata to_metadata() const;

  /// Sets the members that tell of the film and of the seed.
  void set_film(const Film& film, uint64_t seed);

  /// All that makes `other` a different render: "radius 1, here 2" if `other` is called "here".
  /// Empty if both are the same render, so that their passes can be added up.
  std::vector<std::string> differences(const RenderIdentity& other, const std::string& name) const;
};

/// Instruction sets of either list, each once.
std::string joined_instruction_sets(const std::string& a, const std::string& b);

}  // namespace nephroid
