// The symbols of a scene's materials, media and lights: the bridge between scene and automaton. It
// must not know walks.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "route/lamp.h"
#include "route/routes.h"
#include "scene/scene.h"

namespace nephroid {

/// A material on some shape whose lobes may be of class G.
struct GlossyMaterial {
  std::string name;            ///< label and location: "dielectric1 (FILE:LINE:COLUMN)"
  std::optional<float> alpha;  ///< Material::facet_alpha
};

LightKind kind_of(const Light& light);

class SceneSymbols {
 public:
  /// `labels` as Routes::labels().
  SceneSymbols(const Scene& scene, const std::vector<std::string>& labels);

  Label material(int index) const { return materials_[index]; }
  Label medium(int index) const { return media_[index]; }
  /// Symbol of a light, by its index in Scene::lights.
  LightSymbol light(int index) const { return lights_[index]; }
  size_t lights() const { return lights_.size(); }
  /// Symbol of the light that a medium emits.
  LightSymbol glow(int medium_index) const {
    return light_symbol(LightKind::kMedium, medium(medium_index));
  }

  /// Lamp of a light, by its index in Scene::lights. Lights of one label are one lamp.
  Lamp lamp(int light) const { return lamps_[light]; }
  /// Lamp of the light that a medium emits.
  Lamp lamp_of_medium(int medium_index) const { return lamps_of_media_[medium_index]; }
  /// [lamp]: label and location.
  const std::vector<std::string>& lamp_names() const { return lamp_names_; }

  /// The symbols that can occur in this scene, conservatively.
  const SymbolSet& present() const { return present_; }
  /// Materials that may be glossy, smoothest first.
  const std::vector<GlossyMaterial>& glossy_materials() const { return glossy_; }
  /// The band of thresholds up to which microfacets are S.
  const SpecularBand& specular_band() const { return specular_band_; }
  /// Labels of expressions that nothing in the scene has.
  const std::vector<std::string>& unknown_labels() const { return unknown_; }
  /// True if an unknown label belongs to a mix: paths have the labels of its materials instead.
  bool unknown_is_mix() const { return unknown_is_mix_; }

 private:
  void find_surface_events(const Scene& scene);
  void find_lamps(const Scene& scene);
  Lamp new_lamp(const std::string& name);

  std::vector<Label> materials_, media_;
  std::vector<LightSymbol> lights_;
  std::vector<Lamp> lamps_, lamps_of_media_;
  std::vector<std::string> lamp_names_;
  SymbolSet present_;
  std::vector<std::string> unknown_;
  bool unknown_is_mix_ = false;
  std::vector<GlossyMaterial> glossy_;
  SpecularBand specular_band_;
};

/// The routes of an estimator: all routes, the scene's symbols, and the estimator's group. The film
/// numbers parts and groups in the same way.
struct OwnedRoutes {
  std::shared_ptr<const Routes> routes;
  std::shared_ptr<const SceneSymbols> symbols;
  size_t group = 0;
};

}  // namespace nephroid
