// The named textures of a scene: made once, in dependency order, found by name; see texture.h.
#include <algorithm>
#include <array>
#include <exception>
#include <vector>

#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

constexpr SpectrumKind kKinds[] = {SpectrumKind::kAlbedo, SpectrumKind::kUnbounded,
                                   SpectrumKind::kIlluminant};

/// Upper bound of the cost of one texture lookup.
struct TextureCost {
  int depth = 1;     ///< nesting depth of textures, which recurse
  double looks = 1;  ///< total number of lookups; textures that are used twice count twice

  void add(const TextureCost& part) {
    depth = std::max(depth, part.depth + 1);
    looks += part.looks;
  }
};
/// Deeper nesting overflows the stack. The number of lookups can grow exponentially, for example if
/// each texture mixes the one before it with itself.
constexpr int kMaxDepth = 256;
constexpr double kMaxLooks = 10000;

/// A texture that is made when it is first requested.
template <class Ptr>
struct Slot {
  const TextureDescription* description = nullptr;
  bool in_progress = false;
  Ptr texture;
  std::exception_ptr error;  ///< error of a failed attempt to make it

  /// Gets the texture; `where` is the location of the parameter that asks.
  template <class Make>
  const Ptr& get(const SourceLocation& where, Make&& make) {
    if (in_progress)
      throw SceneError(where, "texture \"" + description->name + "\" refers to itself");
    if (!texture && !error) {
      in_progress = true;
      try {
        texture = make(*description);
      } catch (...) {
        error = std::current_exception();
      }
      in_progress = false;
    }
    if (error) std::rethrow_exception(error);
    return texture;
  }
};

}  // namespace

struct TextureLibrary::Impl final : TextureScope {
  Impl(const SceneDescription& scene, Diagnostics& d, uint64_t image_memory)
      : files_(scene.files), diagnostics_(d), images_(image_memory) {
    for (const TextureDescription& t : scene.textures) add(t);
    for (const TextureDescription& t : scene.textures) make_all_kinds(t);
    for (const TextureDescription& t : scene.textures)
      t.parameters.report_unused("texture \"" + t.name + "\"", *find_texture_type(t.type),
                                 diagnostics_);
  }

  void add(const TextureDescription& t) {
    const bool is_float = t.value_type == "float";
    if (!is_float && t.value_type != "spectrum")
      throw SceneError(t.where, "texture \"" + t.name + "\" has values of type \"" + t.value_type +
                                    "\", expected \"float\" or \"spectrum\"");
    if (is_float ? floats_.count(t.name) : spectra_.count(t.name))
      throw SceneError(t.where, t.value_type + " texture \"" + t.name + "\" is defined twice");
    if (t.transform.is_animated())
      diagnostics_.warn(t.where, "a texture cannot move, the start of its motion is used");
    if (!is_invertible(t.transform.start))
      throw SceneError(t.where, "the transform of texture \"" + t.name + "\" has no inverse");
    if (is_float)
      floats_[t.name].description = &t;
    else
      for (auto& slot : spectra_[t.name]) slot.description = &t;
  }

  /// Makes a texture now, so that errors are found even if nothing uses it. Errors of a single kind
  /// wait until that kind is requested: an rgb above 1 is a valid emission but no reflectance, a
  /// value below 0 no emission.
  void make_all_kinds(const TextureDescription& t) {
    if (t.value_type == "float") {
      find_float(t.name, t.where);
      return;
    }
    find_spectrum(t.name, SpectrumKind::kUnbounded, t.where);
    for (const SpectrumKind kind : kKinds) {
      try {
        find_spectrum(t.name, kind, t.where);
      } catch (const SceneError&) {
        if (kind == SpectrumKind::kUnbounded) throw;
      }
    }
  }

  const FloatTexturePtr& find_float(const std::string& name, const SourceLocation& where) {
    const auto it = floats_.find(name);
    if (it == floats_.end())
      throw SceneError(
          where,
          spectra_.count(name)
              ? "texture \"" + name + "\" is a spectrum texture, expected a float one"
              : "there is no float texture named \"" + name + "\", expected the name of a Texture");
    return get(it->second, where,
               [this](const TextureDescription& d) { return make_float_texture(d, *this); });
  }

  const SpectrumTexturePtr& find_spectrum(const std::string& name, SpectrumKind kind,
                                          const SourceLocation& where) {
    const auto it = spectra_.find(name);
    if (it == spectra_.end())
      throw SceneError(where,
                       floats_.count(name)
                           ? "texture \"" + name + "\" is a float texture, expected a spectrum one"
                           : "there is no spectrum texture named \"" + name +
                                 "\", expected the name of a Texture");
    return get(it->second[static_cast<size_t>(kind)], where,
               [&](const TextureDescription& d) { return make_spectrum_texture(d, kind, *this); });
  }

  /// The slot's texture. Its cost is added to the texture under construction that asks for it.
  template <class Ptr, class Make>
  const Ptr& get(Slot<Ptr>& slot, const SourceLocation& where, Make&& make) {
    const Ptr& texture =
        slot.get(where, [&](const TextureDescription& d) { return make_bounded(d, make); });
    if (!in_progress_.empty()) in_progress_.back().add(costs_.at(texture.get()));
    return texture;
  }

  /// Makes a texture. Throws SceneError at its directive if a lookup would cost too much.
  template <class Make>
  auto make_bounded(const TextureDescription& d, Make&& make) {
    struct InProgress {
      std::vector<TextureCost>& costs;
      explicit InProgress(std::vector<TextureCost>& c) : costs(c) { costs.emplace_back(); }
      ~InProgress() { costs.pop_back(); }
    } const in_progress(in_progress_);
    check_depth(d, static_cast<int>(in_progress_.size()));
    auto texture = make(d);
    const TextureCost cost = texture->constant() ? TextureCost() : in_progress_.back();
    check_depth(d, cost.depth);
    if (cost.looks > kMaxLooks)
      throw SceneError(d.where, "texture \"" + d.name + "\" looks up more than " +
                                    std::to_string(static_cast<int>(kMaxLooks)) +
                                    " textures, each counted as often as it is used, expected "
                                    "fewer");
    // It can be one of its own parts, for example if scaled by 1.
    costs_.try_emplace(texture.get(), cost);
    return texture;
  }

  static void check_depth(const TextureDescription& d, int depth) {
    if (depth > kMaxDepth)
      throw SceneError(d.where, "texture \"" + d.name + "\" nests textures more than " +
                                    std::to_string(kMaxDepth) +
                                    " levels deep, expected fewer levels");
  }

  /// The single string of a texture reference.
  static const std::string& reference(const Parameter& p) {
    if (p.strings.size() != 1)
      throw SceneError(p.where, "\"texture " + p.name + "\" needs the name of one texture");
    return p.strings[0];
  }

  FloatTexturePtr find_float_parameter(const ParameterSet& parameters, const std::string& name) {
    const Parameter* p = parameters.find(name, {"float", "texture"});
    if (!p) return nullptr;
    if (p->type == "texture") return find_float(reference(*p), p->where);
    return constant_float_texture(parameters.get_float(name, 0.0f));
  }

  SpectrumTexturePtr find_spectrum_parameter(const ParameterSet& parameters,
                                             const std::string& name, SpectrumKind kind) {
    const Parameter* p = parameters.find(name);
    if (!p) return nullptr;
    if (p->type == "texture") return find_spectrum(reference(*p), kind, p->where);
    return constant_spectrum_texture(spectrum_from_parameter(*p, kind, *files_));
  }

  // TextureScope, for the makers.
  FloatTexturePtr float_texture(const ParameterSet& parameters, const std::string& name,
                                float fallback) override {
    FloatTexturePtr t = find_float_parameter(parameters, name);
    return t ? t : constant_float_texture(fallback);
  }
  SpectrumTexturePtr spectrum_texture(const ParameterSet& parameters, const std::string& name,
                                      SpectrumKind kind, float fallback) override {
    SpectrumTexturePtr t = find_spectrum_parameter(parameters, name, kind);
    return t ? t : constant_spectrum_texture(constant_spectrum(fallback));
  }
  ImageCache& images() override { return images_; }
  SceneFiles& files() override { return *files_; }
  Diagnostics& diagnostics() override { return diagnostics_; }

 private:
  std::shared_ptr<SceneFiles> files_;
  Diagnostics& diagnostics_;
  ImageCache images_;
  std::map<std::string, Slot<FloatTexturePtr>> floats_;
  std::map<std::string, std::array<Slot<SpectrumTexturePtr>, 3>> spectra_;
  std::vector<TextureCost> in_progress_;      ///< textures under construction, innermost last
  std::map<const void*, TextureCost> costs_;  ///< by texture; the textures in the slots stay alive
};

TextureLibrary::TextureLibrary(const SceneDescription& description, Diagnostics& diagnostics,
                               uint64_t image_memory)
    : impl_(std::make_unique<Impl>(description, diagnostics, image_memory)) {}

TextureLibrary::~TextureLibrary() = default;

FloatTexturePtr TextureLibrary::float_texture(const ParameterSet& parameters,
                                              const std::string& name) const {
  return impl_->find_float_parameter(parameters, name);
}

FloatTexturePtr TextureLibrary::float_texture(const ParameterSet& parameters,
                                              const std::string& name, float fallback) const {
  return impl_->float_texture(parameters, name, fallback);
}

SpectrumTexturePtr TextureLibrary::spectrum_texture(const ParameterSet& parameters,
                                                    const std::string& name,
                                                    SpectrumKind kind) const {
  return impl_->find_spectrum_parameter(parameters, name, kind);
}

}  // namespace nephroid
