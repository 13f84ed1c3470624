// Textures from scene text, temporary image files, and texture values as numbers.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input/pbrt_parser.h"
#include "scene/texture/texture.h"
#include "unit/film/scratch_directory.h"

namespace nephroid::testing_texture {

/// A scene's textures, and the warnings of parser and library.
struct Textures {
  explicit Textures(const std::string& text, const std::string& directory = ".")
      : description(parse_pbrt_string("WorldBegin\n" + text, "t.pbrt", directory, diagnostics)),
        library(description, diagnostics) {}

  static ParameterSet reference(const std::string& name) {
    Parameter p;
    p.type = "texture";
    p.name = "x";
    p.strings = {name};
    ParameterSet set;
    set.list.push_back(p);
    return set;
  }
  FloatTexturePtr number(const std::string& name) const {
    return library.float_texture(reference(name), "x");
  }
  SpectrumTexturePtr spectrum(const std::string& name,
                              SpectrumKind kind = SpectrumKind::kAlbedo) const {
    return library.spectrum_texture(reference(name), "x", kind);
  }
  float value(const std::string& name, float u, float v, const Vec3f& p = Vec3f(0.0f)) const {
    TextureContext context;
    context.uv = {u, v};
    context.p = p;
    return number(name)->eval(context);
  }
  /// Mean of a spectrum texture over wavelengths.
  float level(const std::string& name, float u, float v,
              SpectrumKind kind = SpectrumKind::kAlbedo) const {
    TextureContext context;
    context.uv = {u, v};
    return spectrum(name, kind)->eval(context, SampledWavelengths::sample_visible(0.3f)).average();
  }
  std::string warnings() const {
    std::string all;
    for (const Warning& w : diagnostics.warnings()) all += located(w.where, w.message) + "\n";
    return all;
  }

  Diagnostics diagnostics;
  SceneDescription description;
  TextureLibrary library;
};

/// The message of the error that the textures of `text` cause, or "no error".
inline std::string error_of(const std::string& text, const std::string& directory = ".") {
  try {
    const Textures textures(text, directory);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

/// Writes an image file of interleaved values, the top row first.
template <class T>
void write_image(const std::string& path, int width, int height, int channels, OIIO::TypeDesc type,
                 const std::vector<T>& values) {
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto out = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(out && out->open(path, spec)) << OIIO::geterror();
  ASSERT_TRUE(out->write_image(type, values.data())) << out->geterror();
  out->close();
}

inline double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace nephroid::testing_texture
