// Textures: images, samplers and texture coordinates of glTF become textures "imagemap" of the
// scene. Images inside of the file become files in memory. It must not know materials.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/gltf/document.h"
#include "input/parameter_list.h"
#include "input/scene_description.h"

namespace nephroid::gltf {

using Color = ParameterList::Color;

/// The set of texture coordinates of a textureInfo object. KHR_texture_transform may choose
/// another one.
size_t uv_set_of(const JsonValue& info);

/// Which sets of texture coordinates a material uses: a mesh has room for two, and textures name
/// them 0 and 1.
class UvSets {
 public:
  /// The place of a set, which it gets on first use. A third set takes the first place, and the
  /// result is empty.
  std::optional<int> place_of(size_t set);
  /// The glTF sets in use, at most two.
  const std::vector<size_t>& sets() const { return sets_; }

 private:
  std::vector<size_t> sets_;
};

/// The lookup of a float texture: scale * channel, 1 minus that if inverted, then the cutoff.
struct NumberLookup {
  char channel = 'r';
  double scale = 1;
  bool invert = false;
  std::optional<double> cutoff;  ///< values below are 0, all others 1
  bool times_vertex_color = false;
};

class Textures {
 public:
  Textures(Document& document, SceneDescription& scene) : document_(document), scene_(scene) {}

  /// The name of a spectrum texture for a textureInfo object: the image's colours (sRGB encoded)
  /// times the factor and, if wished, the colours of vertices.
  std::string color(const JsonValue& info, const Color& factor, bool times_vertex_color,
                    UvSets& uv_sets);
  /// The name of a float texture of one channel, whose numbers are linear.
  std::string number(const JsonValue& info, const NumberLookup& lookup, UvSets& uv_sets);
  /// Colours and alpha of vertices times a factor, without an image.
  std::string vertex_color(const Color& factor, const SourceLocation& where);
  std::string vertex_alpha(const NumberLookup& lookup, const SourceLocation& where);
  /// The mix of two numbers by a float texture.
  std::string mix(double at_0, double at_1, const std::string& amount, const SourceLocation& where);

  /// The name in the scene of the file of an image. Images inside of the file become files in
  /// memory. Throws SceneError at `wanted_by` if there is no such image.
  std::string image_file(size_t image, const JsonValue& wanted_by);

  /// The image file and the placement over the surface, with a prefix before the names of
  /// parameters, for normal maps and area lights.
  void add_placed_image(ParameterList& list, const std::string& file_parameter,
                        const std::string& prefix, const JsonValue& info, UvSets& uv_sets);

 private:
  std::string image_of(const JsonValue& info);
  std::optional<size_t> image_index(const JsonValue& texture);
  void add_placement(ParameterList& list, const std::string& prefix, const JsonValue& info,
                     UvSets& uv_sets);
  /// The name of an earlier texture with the same parameters, else of a new one.
  std::string add(const std::string& type, const std::string& value_type, ParameterList list);

  Document& document_;
  SceneDescription& scene_;
  std::map<std::string, std::string> known_;   ///< names by contents
  std::map<size_t, std::string> image_files_;  ///< names in the scene by image index
};

}  // namespace nephroid::gltf
