// Learned values of integrators; see targets.h.
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "film/film_settings.h"
#include "fuzz/targets.h"
#include "input/pbrt_parser.h"
#include "integrator/presets/integrator_table.h"
#include "scene/scene.h"

namespace nephroid::fuzz {
namespace {

constexpr size_t kBytesOfChange = 8;
constexpr std::array kIntegrators = {"mixed", "forecast", "mlt"};

/// A lamp over a floor and a ball of glass, on 30 pixels.
constexpr char kSmallScene[] = R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 34
  Film "rgb" "integer xresolution" 6 "integer yresolution" 5
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [3 2.7 2.4]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.5
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Material "dielectric" Translate 0.2 0.7 0 Shape "sphere" "float radius" 0.6
)";

/// A scene, an integrator, and what its estimators have learned: nothing, or their bytes.
struct Sound {
  std::unique_ptr<Scene> scene;
  EstimatorSet set;
  std::vector<std::vector<std::byte>> learned;
};

Film film_for(const Sound& of) {
  return Film(film_settings(of.scene->film), of.set.layout);
}

std::unique_ptr<Sound> sound(const std::string& integrator) {
  Diagnostics diagnostics;
  auto of = std::make_unique<Sound>();
  of->scene =
      build_scene(parse_pbrt_string(kSmallScene, "fuzz.pbrt", ".", diagnostics), {}, diagnostics);
  of->set = make_estimators(plan_of_integrator(integrator), {}, *of->scene);
  const Film film = film_for(*of);
  for (const auto& estimator : of->set.estimators) {
    ByteWriter bytes;
    const auto value = estimator->learn(*of->scene, film.format(), 5, unwatched);
    if (value) value->write(bytes);
    of->learned.push_back(bytes.bytes());
  }
  return of;
}

}  // namespace

/// The first byte chooses the integrator; then come changes to what it has learned: four bytes of
/// offset, four bytes of new data.
void learned(const std::string& bytes) {
  static std::array<std::unique_ptr<Sound>, kIntegrators.size()> sounds;
  if (bytes.empty()) return;
  const size_t number = static_cast<unsigned char>(bytes[0]) % kIntegrators.size();
  std::unique_ptr<Sound>& of = sounds[number];
  if (!of) of = sound(kIntegrators[number]);
  for (size_t e = 0; e < of->learned.size(); ++e) {
    std::vector<std::byte> changed = of->learned[e];
    if (changed.size() < 4) continue;
    for (size_t i = 1; i + kBytesOfChange <= bytes.size(); i += kBytesOfChange) {
      uint32_t at;
      std::memcpy(&at, bytes.data() + i, 4);
      std::memcpy(changed.data() + at % (changed.size() - 3), bytes.data() + i + 4, 4);
    }
    Estimator& estimator = *of->set.estimators[e];
    Film film = film_for(*of);
    try {
      ByteReader reader(changed);
      const auto value = estimator.read_learned(reader, film.format());
      estimator.render_pass({5, 0}, value.get(), *of->scene, film, unwatched);
    } catch (const IoError&) {
    }
  }
}

}  // namespace nephroid::fuzz
