// Textures: float or spectrum values that vary over a surface. One family per file. It must not
// know BSDFs.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/spectra.h"
#include "input/mesh_data.h"
#include "input/scene_description.h"
#include "scene/interaction.h"
#include "scene/texture/image_file.h"

namespace nephroid {

/// Input of a texture lookup.
struct TextureContext {
  Vec3f p{0, 0, 0};  ///< world
  Vec3f n{0, 0, 0};  ///< unit geometric normal, world
  Vec2f uv{0, 0};
  Vec3f dpdx{0, 0, 0}, dpdy{0, 0, 0};
  float dudx = 0, dudy = 0, dvdx = 0, dvdy = 0;
  int face_index = 0;
  const MeshData* mesh = nullptr;  ///< see SurfaceInteraction
  uint32_t primitive = 0;
  Vec2f barycentric{0, 0};

  TextureContext() = default;
  explicit TextureContext(const SurfaceInteraction& s)
      : p(s.p),
        n(s.ng),
        uv(s.uv),
        face_index(s.face_index),
        mesh(s.mesh),
        primitive(s.primitive),
        barycentric(s.barycentric) {}

  /// The second texture coordinates; the first ones on surfaces without.
  Vec2f second_uv() const;
  /// A channel of the vertices' colours, 3 is alpha; 1 on surfaces without.
  float vertex_channel(int channel) const;
  /// The vertices' colour; white on surfaces without.
  Rgb vertex_rgb() const { return {vertex_channel(0), vertex_channel(1), vertex_channel(2)}; }
};

/// How fine a texture is: its details per unit of u and of v, and per unit of world space where it
/// depends on the place. 0 if it does not depend on that, or has no scale of its own.
struct TextureDetail {
  Vec2f per_uv{0, 0};
  float per_length = 0;
  TextureDetail and_also(const TextureDetail& other) const {
    return {{std::max(per_uv.x, other.per_uv.x), std::max(per_uv.y, other.per_uv.y)},
            std::max(per_length, other.per_length)};
  }
};

class FloatTexture {
 public:
  virtual ~FloatTexture() = default;
  virtual float eval(const TextureContext& context) const = 0;
  /// Bump mapping takes differences over half of its finest detail.
  virtual TextureDetail detail() const { return {}; }
  /// The value, if it is the same everywhere.
  virtual std::optional<float> constant() const { return std::nullopt; }
  /// The texture with its stored values multiplied before any other operation. Null for textures
  /// that store none.
  virtual std::shared_ptr<const FloatTexture> with_values_times(float) const { return nullptr; }
};
using FloatTexturePtr = std::shared_ptr<const FloatTexture>;

class SpectrumTexture {
 public:
  virtual ~SpectrumTexture() = default;
  virtual SampledSpectrum eval(const TextureContext& context,
                               const SampledWavelengths& lambda) const = 0;
  /// The spectrum, if it is the same everywhere.
  virtual SpectrumPtr constant() const { return nullptr; }
  /// Same as FloatTexture::with_values_times.
  virtual std::shared_ptr<const SpectrumTexture> with_values_times(float) const { return nullptr; }
};
using SpectrumTexturePtr = std::shared_ptr<const SpectrumTexture>;

/// Conversion of an rgb value to a spectrum (pbrt-v4's SpectrumType).
enum class SpectrumKind { kAlbedo, kUnbounded, kIlluminant };

FloatTexturePtr constant_float_texture(float value);
SpectrumTexturePtr constant_spectrum_texture(SpectrumPtr spectrum);

/// A parameter of type rgb, spectrum (numbers, name or file) or blackbody as a spectrum.
SpectrumPtr spectrum_from_parameter(const Parameter& parameter, SpectrumKind kind,
                                    SceneFiles& files);

/// The named textures of a scene. A spectrum texture exists in three kinds, made on demand.
class TextureLibrary {
 public:
  /// Makes all textures of the description. Throws SceneError for unknown classes, undefined names,
  /// cycles, unreadable images and unsupported features. `image_memory` bounds the bytes of image
  /// pixels.
  TextureLibrary(const SceneDescription& description, Diagnostics& diagnostics,
                 uint64_t image_memory = kDefaultTextureMemory);
  ~TextureLibrary();

  /// The parameter `name`, a number or a "texture" reference; nullptr if absent.
  FloatTexturePtr float_texture(const ParameterSet& parameters, const std::string& name) const;
  /// The same, by default the constant `fallback`.
  FloatTexturePtr float_texture(const ParameterSet& parameters, const std::string& name,
                                float fallback) const;
  /// The parameter `name`, an rgb, spectrum or texture; nullptr if absent.
  SpectrumTexturePtr spectrum_texture(const ParameterSet& parameters, const std::string& name,
                                      SpectrumKind kind) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid
