// Texture class "imagemap". Filters "bilinear", "trilinear" and "ewa" are all bilinear lookups of
// the full image: without ray footprints their limit is the same, and the pixel's samples filter.
#include "scene/texture/image_placement.h"
#include "scene/texture/rgb_spectrum.h"
#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// Code shared by float and spectrum image textures.
class ImageLookup {
 public:
  ImageLookup(const TextureDescription& description, TextureScope& scope)
      : mapping_(description),
        placement_(description.parameters, "", wrap_mode(description.parameters)),
        times_vertex_color_(description.parameters.get_bool("vertexcolor", false)) {
    const ParameterSet& p = description.parameters;
    placement_.choose_set(p, "");
    const std::string filter = p.get_string("filter", "bilinear");
    if (filter != "point" && filter != "bilinear" && filter != "trilinear" && filter != "ewa" &&
        filter != "EWA")
      throw SceneError(p.find("filter")->where,
                       "unknown texture filter \"" + filter +
                           "\", expected \"point\", \"bilinear\", \"trilinear\" or \"ewa\"");
    point_ = filter == "point";

    scale_ = p.get_float("scale", 1.0f);
    invert_ = p.get_bool("invert", false);

    const std::string file = p.get_string("filename", "");
    if (file.empty())
      throw SceneError(description.where, "texture \"" + description.name +
                                              "\" has no \"filename\", expected an image file");
    image_ = scope.images().get(scope.files().source_of(file), encoding(p, file, scope),
                                p.find("filename")->where);
  }

  /// Reads what only float textures have.
  void read_number_parameters(const ParameterSet& p) {
    channel_ = read_channel(p);
    cutoff_ = read_cutoff(p);
  }
  /// Reads what only spectrum textures have.
  void read_color_parameters(const ParameterSet& p) { factor_ = read_factor(p); }

  float number(const TextureContext& context) const {
    float v = scale_ * stored_number(position(context));
    if (times_vertex_color_) v *= context.vertex_channel(channel_.value_or(3));
    return after_cutoff(invert_ ? std::max(0.0f, 1.0f - v) : v, cutoff_);
  }
  Rgb colour(const TextureContext& context) const {
    const Vec2f st = position(context);
    const WrapModes wrap = placement_.wrap();
    Rgb c = (point_ ? image_->nearest(st, wrap) : image_->bilinear(st, wrap)) * scale_;
    if (invert_) c = {1.0f - c.r, 1.0f - c.g, 1.0f - c.b};
    c = product(c, factor_);
    if (times_vertex_color_) c = product(c, context.vertex_rgb());
    return {std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b)};
  }
  TextureDetail detail() const {
    return mapping_.detail(placement_.pixels_per_uv(static_cast<float>(image_->width()),
                                                    static_cast<float>(image_->height())));
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
    const bool is_forced = p.get_bool("forceencoding", false);
    if (name.empty()) return std::nullopt;
    const SourceLocation& where = p.find("encoding")->where;
    const auto parsed = ColorEncoding::parse(name);
    if (!parsed)
      throw SceneError(where, "unknown encoding \"" + name +
                                  "\", expected \"linear\", \"sRGB\" or \"gamma X\" with X > 0");
    if (is_forced || image_obeys_encoding(file)) return parsed;
    scope.diagnostics().warn(where,
                             "\"encoding\" is used for PNG images only: \"" + file +
                                 "\" is read as sRGB if it stores integers, otherwise as linear");
    return std::nullopt;
  }
  /// The mode of both axes by "wrap".
  static WrapMode wrap_mode(const ParameterSet& p) {
    const std::string wrap = p.get_string("wrap", "repeat");
    if (const auto mode = parse_wrap_mode(wrap)) return *mode;
    throw SceneError(p.find("wrap")->where,
                     "unknown wrap mode \"" + wrap +
                         "\", expected \"repeat\", \"mirror\", \"black\", \"clamp\" or "
                         "\"octahedralsphere\"");
  }
  Vec2f position(const TextureContext& context) const {
    TextureContext used = context;
    used.uv = placement_.coordinates(context);
    return placement_.in_image(mapping_.map(used));
  }
  float stored_number(const Vec2f& st) const {
    const WrapModes wrap = placement_.wrap();
    if (channel_)
      return point_ ? image_->nearest_channel(st, wrap, *channel_)
                    : image_->bilinear_channel(st, wrap, *channel_);
    return point_ ? image_->nearest_float(st, wrap) : image_->bilinear_float(st, wrap);
  }

  TextureMapping2D mapping_;
  ImagePlacement placement_;
  ImagePtr image_;
  float scale_ = 1.0f;
  Rgb factor_{1, 1, 1};
  std::optional<int> channel_;
  std::optional<float> cutoff_;
  bool invert_ = false, point_ = false, times_vertex_color_ = false;
};

class ImageFloatTexture final : public FloatTexture {
 public:
  explicit ImageFloatTexture(ImageLookup lookup) : lookup_(std::move(lookup)) {}
  float eval(const TextureContext& context) const override { return lookup_.number(context); }
  TextureDetail detail() const override { return lookup_.detail(); }
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
    return spectrum_of(lookup_.colour(context), lookup_.color_space(), kind_, lambda);
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
  ImageLookup lookup(description, scope);
  lookup.read_number_parameters(description.parameters);
  return std::make_shared<ImageFloatTexture>(std::move(lookup));
}

SpectrumTexturePtr make_spectrum_imagemap(const TextureDescription& description, SpectrumKind kind,
                                          TextureScope& scope) {
  ImageLookup lookup(description, scope);
  lookup.read_color_parameters(description.parameters);
  return std::make_shared<ImageSpectrumTexture>(std::move(lookup), kind);
}

}  // namespace nephroid
