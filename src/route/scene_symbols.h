// Which symbols the materials, media and lights of a scene are: the bridge between a scene and the
// automaton. Who calls it: integrators (symbols of events and lights) and the compiler's callers
// (what can occur in a scene). It must not know walks.
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
  std::string name;            ///< its label and where it stands: "dielectric1 (FILE:LINE:COLUMN)"
  std::optional<float> alpha;  ///< as Material::facet_alpha
};

class SceneSymbols {
 public:
  /// `labels` as Routes::labels().
  SceneSymbols(const Scene& scene, const std::vector<std::string>& labels);

  Label material(int index) const { return materials_[index]; }
  Label medium(int index) const { return media_[index]; }
  /// Of Scene::lights.
  LightSymbol light(int index) const { return lights_[index]; }
  size_t lights() const { return lights_.size(); }
  /// Of the light that a medium emits.
  LightSymbol glow(int medium_index) const {
    return light_symbol(LightKind::kMedium, medium(medium_index));
  }

  /// What lights are told apart by in reports: those of one label are one lamp. Of Scene::lights.
  Lamp lamp(int light) const { return lamps_[light]; }
  /// Of the light that a medium emits.
  Lamp lamp_of_medium(int medium_index) const { return lamps_of_media_[medium_index]; }
  /// [lamp]: label and place; the last of kMaxLamps is all that do not fit.
  const std::vector<std::string>& lamp_names() const { return lamp_names_; }

  /// What can occur in this scene: a conservative answer.
  const SymbolSet& present() const { return present_; }
  /// Materials that may be glossy, smoothest first.
  const std::vector<GlossyMaterial>& glossy_materials() const { return glossy_; }
  /// The band of thresholds at and below which microfacets are of class S.
  const SpecularBand& specular_band() const { return specular_band_; }
  /// Labels that nothing in the scene goes by: a warning.
  const std::vector<std::string>& unknown_labels() const { return unknown_; }
  /// True if a label is unknown only because a mix goes by those of its materials.
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

/// What an estimator needs to know of routes: all of them, their symbols in the scene, and which
/// group of them it owns. Parts are numbered in the film as here, a group's index is the same in
/// both.
struct OwnedRoutes {
  std::shared_ptr<const Routes> routes;
  std::shared_ptr<const SceneSymbols> symbols;
  size_t group = 0;
};

}  // namespace nephroid
