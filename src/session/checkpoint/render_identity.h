// The identity of a render in the metadata of its picture, and the keys of all metadata that the
// program writes. It must not know the progress of a render (checkpoint.h).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "film/film.h"
#include "film/image_io.h"

namespace nephroid {

/// Prefix of all metadata keys of the program.
inline constexpr std::string_view kKeyPrefix = "nephroid:";

// Keys of the render: the members of RenderIdentity.
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
// Key of the film, read by the program only (film_metadata.h).
inline constexpr const char* kLayoutKey = "nephroid:layout";
// Keys of the progress (checkpoint.h).
inline constexpr const char* kPassesKey = "nephroid:passes";
inline constexpr const char* kOpenPassKey = "nephroid:unfinished_pass";
inline constexpr const char* kSecondsKey = "nephroid:seconds";
inline constexpr const char* kHistoryKey = "nephroid:history";
inline constexpr const char* kChoicesKey = "nephroid:choices";
inline constexpr const char* kOutlierEstimatesKey = "nephroid:outlier_estimates";
inline constexpr const char* kEstimatesKey = "nephroid:estimates:";  ///< + name of a route

/// A render as text, for its picture's metadata. Empty members are left out.
struct RenderIdentity {
  std::string version;     ///< program version
  std::string scene_hash;  ///< hash of all files of the scene
  std::string film;        ///< resolution and crop window
  std::string routes;      ///< one route a line, in their order of precedence
  std::string aovs;        ///< one AOV a line
  std::string options;     ///< "key=value" of every -D key, separated by spaces
  std::string outliers;    ///< "reject" if the film rejects outliers
  std::string seed;

  // Informative: two pictures of the same render may differ in these.
  std::string scene;             ///< file name
  std::string integrator;        ///< integrator, preset or file of the routes
  std::string instruction_sets;  ///< instruction sets of all runs (version.h), separated by "; "

  /// Version and instruction set of this program; all else is empty.
  static RenderIdentity of_this_program();
  /// The identity in a picture's metadata.
  static RenderIdentity from_metadata(const Metadata& metadata);
  Metadata to_metadata() const;

  /// Sets the members of the film and the seed.
  void set_film(const Film& film, uint64_t seed);

  /// The differences that make `other` another render, such as "radius 1, here 2"; `name` ("here")
  /// is the word for `other`. Empty if both are the same render, so that their passes add up.
  std::vector<std::string> differences(const RenderIdentity& other, const std::string& name) const;
};

/// The instruction sets of both lists, each once.
std::string joined_instruction_sets(const std::string& a, const std::string& b);

}  // namespace nephroid
