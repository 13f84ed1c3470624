// Texture class "checkerboard" in two or three dimensions, evaluated at points: filtering over a
// pixel is left to the pixel's samples.
#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// Chooses between the two textures at a point. Squares (or cubes) have unit size; the one with
/// coordinates from 0 to 1 has the first texture.
class Board {
 public:
  explicit Board(const TextureDescription& description)
      : dimension_(description.parameters.get_int("dimension", 2)),
        flat_(description),
        solid_(description) {
    if (dimension_ != 2 && dimension_ != 3)
      throw SceneError(description.parameters.find("dimension")->where,
                       "a checkerboard of " + std::to_string(dimension_) +
                           " dimensions cannot be made, expected 2 or 3");
  }
  bool is_first(const TextureContext& context) const {
    if (dimension_ == 2) {
      const Vec2f st = flat_.map(context);
      return odd(st.x) == odd(st.y);
    }
    const Vec3f p = solid_.map(context);
    return (odd(p.x) != odd(p.y)) == odd(p.z);
  }

 private:
  /// True if the cell that contains the coordinate has an odd index. Uses float: an integer could
  /// overflow.
  static bool odd(float v) {
    const float cell = std::floor(v);
    return cell - 2.0f * std::floor(cell * 0.5f) != 0.0f;
  }
  int dimension_;
  TextureMapping2D flat_;
  TextureMapping3D solid_;
};

class CheckerboardFloatTexture final : public FloatTexture {
 public:
  CheckerboardFloatTexture(Board board, FloatTexturePtr first, FloatTexturePtr second)
      : board_(std::move(board)), first_(std::move(first)), second_(std::move(second)) {}
  float eval(const TextureContext& context) const override {
    return (board_.is_first(context) ? first_ : second_)->eval(context);
  }
  TextureDetail detail() const override { return first_->detail().and_also(second_->detail()); }

 private:
  Board board_;
  FloatTexturePtr first_, second_;
};

class CheckerboardSpectrumTexture final : public SpectrumTexture {
 public:
  CheckerboardSpectrumTexture(Board board, SpectrumTexturePtr first, SpectrumTexturePtr second)
      : board_(std::move(board)), first_(std::move(first)), second_(std::move(second)) {}
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    return (board_.is_first(context) ? first_ : second_)->eval(context, lambda);
  }

 private:
  Board board_;
  SpectrumTexturePtr first_, second_;
};

}  // namespace

FloatTexturePtr make_float_checkerboard(const TextureDescription& description,
                                        TextureScope& scope) {
  return std::make_shared<CheckerboardFloatTexture>(
      Board(description), scope.float_texture(description.parameters, "tex1", 1.0f),
      scope.float_texture(description.parameters, "tex2", 0.0f));
}

SpectrumTexturePtr make_spectrum_checkerboard(const TextureDescription& description,
                                              SpectrumKind kind, TextureScope& scope) {
  return std::make_shared<CheckerboardSpectrumTexture>(
      Board(description), scope.spectrum_texture(description.parameters, "tex1", kind, 1.0f),
      scope.spectrum_texture(description.parameters, "tex2", kind, 0.0f));
}

}  // namespace nephroid
