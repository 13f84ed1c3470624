// The identity of a render in the metadata of its picture. It must not know the progress of a
// render (checkpoint.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "film/film.h"
#include "film/image_io.h"
#include "film/metadata_keys.h"

namespace nephroid {

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
  std::string layers_by_light;   ///< one layer a line (film/layers_by_light.h)
  std::string max_component;     ///< limit of a sample's components; empty: none
  std::string instruction_sets;  ///< instruction sets of all runs (version.h), separated by "; "

  /// Version and instruction set of this program; all else is empty.
  static RenderIdentity of_this_program();
  /// The identity in a picture's metadata.
  static RenderIdentity from_metadata(const Metadata& metadata);
  Metadata to_metadata() const;

  /// Sets the members that the film decides, and the seed.
  void set_film(const Film& film, uint64_t seed);

  /// The differences that make `other` another render, such as "radius 1, here 2"; `name` ("here")
  /// is the word for `other`. Empty if both are the same render, so that their passes add up.
  std::vector<std::string> differences(const RenderIdentity& other, const std::string& name) const;
};

/// The instruction sets of both lists, each once.
std::string joined_instruction_sets(const std::string& a, const std::string& b);

}  // namespace nephroid
