// Learned values of integrators; see targets.h.
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "film/film_settings.h"
#include "film/render_state.h"
#include "fuzz/targets.h"
#include "input/pbrt_parser.h"
#include "integrator/metropolis/metropolis_options.h"
#include "integrator/presets/integrator_table.h"
#include "scene/scene.h"

namespace nephroid::fuzz {
namespace {

constexpr size_t kBytesOfChange = 8;
constexpr std::array kIntegrators = {"mixed", "forecast", "mlt", "pssmlt", "pointlights"};

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

const Scene& small_scene() {
  static const std::unique_ptr<Scene> scene = [] {
    Diagnostics diagnostics;
    return build_scene(parse_pbrt_string(kSmallScene, "fuzz.pbrt", ".", diagnostics), {},
                       diagnostics);
  }();
  return *scene;
}

/// An integrator with a film, and the streams of a state that hold what its estimators learn.
struct Render {
  explicit Render(const std::string& integrator)
      : set(make_estimators(plan_of_integrator(integrator), options(), small_scene())),
        film(film_settings(small_scene().film), set.layout) {
    set.learned.resize(set.estimators.size());
    for (size_t i = 0; i < set.estimators.size(); ++i)
      set.learned[i].add_state(*set.estimators[i], film.format(), "optional.learned", state);
  }
  static IntegratorOptions options() {
    IntegratorOptions options;
    options.edit<MetropolisOptions>().mutations = 1;
    return options;
  }
  void pass() { set.render_pass({5, 0}, small_scene(), film, unwatched); }

  EstimatorSet set;
  Film film;
  RenderState state;
};

/// The words that the estimators save in a state after a pass.
const std::vector<std::vector<uint32_t>>& sound_words(size_t integrator) {
  static std::array<std::vector<std::vector<uint32_t>>, kIntegrators.size()> all;
  if (all[integrator].empty()) {
    Render render(kIntegrators[integrator]);
    render.pass();
    for (const RenderState::Stream& stream : render.state.streams)
      all[integrator].push_back(stream.save());
  }
  return all[integrator];
}

}  // namespace

/// The first byte chooses the integrator, the second says how many words are cut off at the end;
/// then come changes to words that it has saved: four bytes of place, four bytes of value.
void learned(const std::string& bytes) {
  if (bytes.size() < 2) return;
  const size_t number = static_cast<unsigned char>(bytes[0]) % kIntegrators.size();
  const size_t cut = static_cast<unsigned char>(bytes[1]);
  const std::vector<std::vector<uint32_t>>& sound = sound_words(number);
  Render render(kIntegrators[number]);
  for (size_t s = 0; s < sound.size(); ++s) {
    std::vector<uint32_t> words = sound[s];
    for (size_t i = 2; i + kBytesOfChange <= bytes.size() && !words.empty(); i += kBytesOfChange) {
      uint32_t place, value;
      std::memcpy(&place, bytes.data() + i, 4);
      std::memcpy(&value, bytes.data() + i + 4, 4);
      words[place % words.size()] = value;
    }
    words.resize(words.size() - std::min(cut, words.size()));
    try {
      render.state.streams[s].load(words);
    } catch (const IoError&) {
    }
  }
  render.pass();
}

}  // namespace nephroid::fuzz
