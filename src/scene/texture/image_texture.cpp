// Texture class "imagemap". Filters "bilinear", "trilinear" and "ewa" are all bilinear lookups of
// the full image: without ray footprints their limit is the same, and the pixel's samples filter.
#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// Code shared by float and spectrum image textures.
class ImageLookup {
 public:
  ImageLookup(const TextureDescription& description, TextureScope& scope) : mapping_(description) {
    const ParameterSet& p = description.parameters;
    const std::string filter = p.get_string("filter", "bilinear");
    if (filter != "point" && filter != "bilinear" && filter != "trilinear" && filter != "ewa" &&
        filter != "EWA")
      throw SceneError(p.find("filter")->where,
                       "unknown texture filter \"" + filter +
                           "\", expected \"point\", \"bilinear\", \"trilinear\" or \"ewa\"");
    point_ = filter == "point";

    const std::string wrap = p.get_string("wrap", "repeat");
    const auto mode = parse_wrap_mode(wrap);
    if (!mode)
      throw SceneError(p.find("wrap")->where,
                       "unknown wrap mode \"" + wrap +
                           "\", expected \"repeat\", \"black\", \"clamp\" or \"octahedralsphere\"");
    wrap_ = *mode;
    scale_ = p.get_float("scale", 1.0f);
    invert_ = p.get_bool("invert", false);

    const std::string file = p.get_string("filename", "");
    if (file.empty())
      throw SceneError(description.where, "texture \"" + description.name +
                                              "\" has no \"filename\", expected an image file");
    const std::string path = scope.files().counted_path_of(file);
    image_ = scope.images().get(path, encoding(p, file, scope), p.find("filename")->where);
  }

  float number(const TextureContext& context) const {
    const Vec2f st = position(context);
    const float v =
        scale_ * (point_ ? image_->nearest_float(st, wrap_) : image_->bilinear_float(st, wrap_));
    return invert_ ? std::max(0.0f, 1.0f - v) : v;
  }
  Rgb colour(const TextureContext& context) const {
    const Vec2f st = position(context);
    Rgb c = (point_ ? image_->nearest(st, wrap_) : image_->bilinear(st, wrap_)) * scale_;
    if (invert_) c = {1.0f - c.r, 1.0f - c.g, 1.0f - c.b};
    return {std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)};
  }
  const RgbColorSpace& color_space() const { return image_->color_space(); }
  ImageLookup times(float factor) const {
    ImageLookup copy = *this;
    copy.scale_ *= factor;
    return copy;
  }

 private:
  /// The encoding requested by the scene, if any.
  static std::optional<ColorEncoding> encoding(const ParameterSet& p, const std::string& file,
                                               TextureScope& scope) {
    const std::string name = p.get_string("encoding", "");
    if (name.empty()) return std::nullopt;
    const SourceLocation& where = p.find("encoding")->where;
    const auto parsed = ColorEncoding::parse(name);
    if (!parsed)
      throw SceneError(where, "unknown encoding \"" + name +
                                  "\", expected \"linear\", \"sRGB\" or \"gamma X\" with X > 0");
    if (image_obeys_encoding(file)) return parsed;
    scope.diagnostics().warn(where,
                             "\"encoding\" is used for PNG images only: \"" + file +
                                 "\" is read as sRGB if it stores integers, otherwise as linear");
    return std::nullopt;
  }
  /// Images have their first row on top; v runs upwards.
  Vec2f position(const TextureContext& context) const {
    const Vec2f st = mapping_.map(context);
    return {st.x, 1.0f - st.y};
  }

  TextureMapping2D mapping_;
  ImagePtr image_;
  WrapMode wrap_ = WrapMode::kRepeat;
  float scale_ = 1.0f;
  bool invert_ = false, point_ = false;
};

class ImageFloatTexture final : public FloatTexture {
 public:
  explicit ImageFloatTexture(ImageLookup lookup) : lookup_(std::move(lookup)) {}
  float eval(const TextureContext& context) const override { return lookup_.number(context); }
  FloatTexturePtr with_values_times(float factor) const override {
    return std::make_shared<ImageFloatTexture>(lookup_.times(factor));
  }

 private:
  ImageLookup lookup_;
};

class ImageSpectrumTexture final : public SpectrumTexture {
 public:
  ImageSpectrumTexture(ImageLookup lookup, SpectrumKind kind)
      : lookup_(std::move(lookup)), kind_(kind) {}

  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    const Rgb c = lookup_.colour(context);
    const RgbColorSpace& space = lookup_.color_space();
    if (kind_ == SpectrumKind::kAlbedo) return space.polynomial(c).sample(lambda);
    // An unbounded colour is represented as a reflectance of at most 1/2 times a scale.
    const float scale = 2.0f * std::max({c.r, c.g, c.b});
    if (!(scale > 0.0f)) return SampledSpectrum();
    const SampledSpectrum s = space.polynomial(c * (1.0f / scale)).sample(lambda) * scale;
    return kind_ == SpectrumKind::kUnbounded ? s : s * space.illuminant().sample(lambda);
  }
  SpectrumTexturePtr with_values_times(float factor) const override {
    return std::make_shared<ImageSpectrumTexture>(lookup_.times(factor), kind_);
  }

 private:
  ImageLookup lookup_;
  SpectrumKind kind_;
};

}  // namespace

FloatTexturePtr make_float_imagemap(const TextureDescription& description, TextureScope& scope) {
  return std::make_shared<ImageFloatTexture>(ImageLookup(description, scope));
}

SpectrumTexturePtr make_spectrum_imagemap(const TextureDescription& description, SpectrumKind kind,
                                          TextureScope& scope) {
  return std::make_shared<ImageSpectrumTexture>(ImageLookup(description, scope), kind);
}

}  // namespace nephroid
