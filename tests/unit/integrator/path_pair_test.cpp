// MIS weights of path pairs against brute force: both walks are repeated and recorded, and the
// densities of all techniques are multiplied up by [W1]. The walks' partial weights are not used.
#include "integrator/bidirectional/path_pair.h"

#include <gtest/gtest.h>

#include <map>

#include "owned_routes.h"
#include "photon/emission.h"
#include "rendering.h"
#include "transport/direct_light.h"

namespace nephroid {
namespace {

using namespace testing_support;

/// A vertex of an eye or light path. Its material has one class.
struct Vertex {
  Vec3f p, ng{0, 0, 0}, ns{0, 0, 0};
  std::shared_ptr<BsdfArena> arena;
  const Bsdf* bsdf = nullptr;  // null in a medium
  Frame frame;
  HenyeyGreenstein phase;
  bool delta = false;

  double cosine(const Vec3f& w) const { return length_squared(ng) > 0 ? abs_dot(ng, w) : 1.0; }
  /// Density of scattering from direction `from` into `to`, both unit vectors in world space.
  double density(const Vec3f& from, const Vec3f& to, TransportMode mode) const {
    if (delta) return 1;
    if (!bsdf) return phase.eval(from, to);
    for (const EventClass c : kSurfaceClasses)
      if (contains(bsdf->classes(), c))
        return bsdf->eval(frame.to_local(from), frame.to_local(to), mode, c, ClassMask::kAll).pdf_w;
    return 0;
  }
};

/// The end of a path on a light.
struct LightEnd {
  int light = -1;
  Vec3f p{0, 0, 0}, ng{0, 0, 0};
  Vec3f w{0, 0, 0};  ///< direction towards an infinite light
};

/// Records the vertices of a walk.
class Recorder {
 public:
  explicit Recorder(const Scene& scene) : scene_(scene) {}
  void escape(const Walk& walk) {
    for (const int i : scene_.light_sampler->infinite_lights())
      if (!scene_.lights[static_cast<size_t>(i)]->is_delta())
        hits[walk.events] = {i, {0, 0, 0}, {0, 0, 0}, walk.ray.d};
  }
  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light&) {
    hits[walk.events] = {hit.area_light, hit.p, hit.ng, {0, 0, 0}};
  }
  void medium_emission(const Medium&, const SampledSpectrum&) {}
  ClassMask useful(const WalkVertex&) { return ClassMask::kAll; }
  bool scatters_in(const Medium&) { return true; }
  bool looks_under_surfaces() { return false; }
  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    Vertex x;
    x.p = v.surface.p;
    x.ng = v.surface.ng;
    x.ns = v.surface.shading.z;
    x.frame = v.surface.shading;
    x.arena = std::make_shared<BsdfArena>();
    SampledWavelengths lambda = walk.lambda;
    x.bsdf = v.material.make_bsdf(v.surface, lambda, walk.specular_alpha, *x.arena);
    vertices.push_back(x);
    if (wants_direct)
      direct.push_back(
          sample_direct(scene_, Receiver::of(v.surface, walk.medium), walk.lambda, sampler));
  }
  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    Vertex x;
    x.p = v.p;
    x.phase = v.phase;
    vertices.push_back(x);
    if (!wants_direct) return;
    EXPECT_EQ(v.lit_along, samples_light_along(v.medium, walk.lambda));
    direct.push_back(
        v.lit_along ? std::nullopt
                    : sample_direct(scene_, Receiver::of(v, walk.medium), walk.lambda, sampler));
  }
  bool looks_along(const Medium&) const { return wants_direct; }
  void light_along(const Walk& walk, const FlightLight& found, PathSampler&) {
    Vertex x;
    x.p = found.vertex.p;
    x.phase = found.vertex.phase;
    along[walk.events].push_back({x, found.direct});
  }
  bool scatter(const Walk& walk, const WalkEvent&) {
    vertices.back().delta = walk.delta;
    return true;
  }

  bool wants_direct = false;
  std::vector<Vertex> vertices;
  std::vector<std::optional<DirectSample>> direct;
  /// [events before it] light samples of flights, with the vertices that they make.
  std::map<int, std::vector<std::pair<Vertex, DirectSample>>> along;
  std::map<int, LightEnd> hits;  ///< [events before it]

 private:
  const Scene& scene_;
};

/// Densities of all techniques of one path, [W1].
class BruteForce {
 public:
  BruteForce(const Scene& scene, std::vector<Vertex> vertices, const LightEnd& end, double camera,
             double light_paths)
      : scene_(scene),
        x_(std::move(vertices)),
        end_(end),
        light_(*scene.lights[static_cast<size_t>(end.light)]),
        camera_(camera),
        light_paths_(light_paths) {}

  double weight(int s, const Vec3f& lens) const {
    double sum = 0;
    const int k = static_cast<int>(x_.size());
    for (int j = 0; j <= k + 1; ++j) sum += sqr(density(j, lens));
    return sqr(density(s, lens)) / sum;
  }

 private:
  Vec3f place(int i, const Vec3f& lens) const {  // 0: lens, k + 1: light
    return i == 0                             ? lens
           : i <= static_cast<int>(x_.size()) ? x_[static_cast<size_t>(i) - 1].p
                                              : end_.p;
  }
  Vec3f direction(int a, int b, const Vec3f& lens) const {
    const int n = static_cast<int>(x_.size()) + 1;
    if (light_.is_infinite() && b == n) return end_.w;
    if (light_.is_infinite() && a == n) return -end_.w;
    return normalize(place(b, lens) - place(a, lens));
  }
  const Vertex& at(int i) const { return x_[static_cast<size_t>(i) - 1]; }
  double factor(int a, int b, const Vec3f& lens) const {
    const int n = static_cast<int>(x_.size()) + 1;
    const bool infinite = light_.is_infinite() && (a == n || b == n);
    const Vec3f w = direction(a, b, lens);
    double cosine = 1;
    if (b < n)
      cosine = at(b).cosine(w);
    else if (!infinite && length_squared(end_.ng) > 0)
      cosine = abs_dot(end_.ng, w);
    return cosine / (infinite ? 1.0 : double{length_squared(place(b, lens) - place(a, lens))});
  }
  double from_eye(int i, const Vec3f& lens) const {
    if (i == 1) return camera_;
    return at(i - 1).density(direction(i - 1, i - 2, lens), direction(i - 1, i, lens),
                             TransportMode::kRadiance) *
           factor(i - 1, i, lens);
  }
  double from_light(int i, const Vec3f& lens) const {
    const int k = static_cast<int>(x_.size());
    const Vec3f w = direction(k + 1, k, lens);
    const EmissionDensity e = light_.emission_pdf(end_.ng, w);
    const double chosen = scene_.light_sampler->pmf_by_power(end_.light);
    if (i == k + 1) return chosen * (light_.is_infinite() ? e.pdf_w : e.pdf_a);
    if (i == k) return (light_.is_infinite() ? e.pdf_a : e.pdf_w) * factor(k + 1, k, lens);
    return at(i + 1).density(direction(i + 1, i + 2, lens), direction(i + 1, i, lens),
                             TransportMode::kImportance) *
           factor(i + 1, i, lens);
  }
  double direct(const Vec3f& lens) const {
    const int k = static_cast<int>(x_.size());
    const Vec3f w = direction(k, k + 1, lens);
    const double chosen = scene_.light_sampler->pmf(at(k).p, at(k).ns, end_.light);
    if (light_.is_delta()) return chosen * light_.emission_pdf(end_.ng, -w).pdf_a / scale();
    const double solid = light_.pdf_towards(at(k).p, w, end_.p, end_.ng);
    return chosen * solid * (light_.is_infinite() ? 1 : factor(k, k + 1, lens));
  }
  /// The measure for the start of a distant light: that of directions.
  double scale() const {
    return light_.is_infinite() ? double{light_.emission_pdf(end_.ng, -end_.w).pdf_a} : 1.0;
  }
  double density(int s, const Vec3f& lens) const {
    const int k = static_cast<int>(x_.size()), t = k + 2 - s;
    if (s == 0 && light_.is_delta()) return 0;
    if (s == 1 && at(k).delta) return 0;
    if (s > 1 && at(t).delta) return 0;
    if (s > 1 && t > 1 && at(t - 1).delta) return 0;
    double p = t == 1 ? light_paths_ : 1;
    for (int i = 1; i < t; ++i) p *= from_eye(i, lens);
    if (s == 1) return p * direct(lens);
    for (int i = t; i <= k + 1; ++i) p *= from_light(i, lens);
    return p;
  }

  const Scene& scene_;
  std::vector<Vertex> x_;
  LightEnd end_;
  const Light& light_;
  double camera_, light_paths_;
};

const std::string kView = R"(
  LookAt 0 3.2 -4  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 12 "integer yresolution" 12
  WorldBegin
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
  Shape "bilinearmesh" "point3 P" [-3 0 3  3 0 3  -3 2 3  3 2 3]
  AttributeBegin
    Material "dielectric"
    Translate -0.9 0.7 0 Shape "sphere" "float radius" 0.6
  AttributeEnd
  AttributeBegin
    Material "conductor" "float roughness" 0.5
    Translate 0.9 0.7 0.3 Shape "sphere" "float radius" 0.5
  AttributeEnd
  AttributeBegin
    Material "dielectric" "float roughness" 0.4
    Translate 0.1 0.4 -1 Shape "sphere" "float radius" 0.35
  AttributeEnd
)";
const std::string kLamp = R"(
  AttributeBegin
    Translate 0 3 0 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [9 8 7]
    Shape "disk" "float radius" 0.9
  AttributeEnd
)";

struct Lights {
  const char* name;
  std::string text;
};

class PathPair : public ::testing::TestWithParam<Lights> {};

TEST_P(PathPair, WeightsAreThoseOfBruteForce) {
  const auto scene = scene_from_text(kView + GetParam().text);
  const OwnedRoutes owned = owned_routes(*scene, {"all=.*:bdpt", "rest=.*:path"});
  const CameraView view(*scene, {0, 0, 12, 12});
  PairSettings settings{*scene, owned};
  settings.view = &view;
  settings.max_depth = 6;
  settings.light_paths = 144;
  settings.specular_alpha = 0.05f;
  std::map<std::pair<int, int>, int> checked;
  double worst = 0;
  int outliers = 0, count = 0;
  for (int pixel = 0; pixel < 144; ++pixel)
    for (uint32_t index = 0; index < 32; ++index) {
      const SobolPoint point(index);
      const int x = pixel % 12, y = pixel / 12;
      const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
      const uint64_t seed = static_cast<uint64_t>(pixel);
      const auto start = [&](PathSampler& sampler) {
        CameraPath camera = start_camera_path(*scene, x, y, sampler, lambda, 0.5f);
        camera.walk.specular_alpha = settings.specular_alpha;
        camera.walk.per_wavelength = true;
        return camera;
      };
      // Repeat the two walks.
      PathSampler eye_sampler(point, seed);
      CameraPath camera = start(eye_sampler);
      const Vec3f lens = camera.walk.ray.o;
      Recorder eye(*scene), light(*scene);
      eye.wants_direct = true;
      random_walk(*scene, TransportMode::kRadiance, settings.max_depth, camera.walk, eye_sampler,
                  eye);
      PathSampler light_sampler(point, seed + 1000000);
      light_sampler.start_dimension(0);
      const auto emission = emit(*scene, kUnguided, lambda, 0.5f, light_sampler);
      LightEnd origin;
      if (emission) {
        Walk walk;
        walk.lambda = lambda;
        walk.ray = emission->ray;
        walk.medium = emission->medium;
        walk.specular_alpha = settings.specular_alpha;
        walk.per_wavelength = true;
        walk.first_dimension = kEmissionDimensions;
        walk.second_dimension = kEmissionDimensions + dimensions::kPerVertex;
        random_walk(*scene, TransportMode::kImportance, settings.max_depth, walk, light_sampler,
                    light);
        const Light& l = *scene->lights[static_cast<size_t>(emission->light)];
        origin = {emission->light, l.is_area() ? emission->start.p : emission->ray.o,
                  l.is_area() ? emission->start.ng : Vec3f(0, 0, 0), -emission->ray.d};
      }
      for (int s = 0; s <= 4; ++s)
        for (int t = 1; t <= 4; ++t) {
          // The weight is the ratio of light with and without weights.
          double light_sum[2] = {};
          for (const bool weighted : {false, true}) {
            settings.technique = {s, t, true, weighted};
            LightSubpath path;
            std::vector<CameraSplat> seen;
            PathSampler to_light(point, seed + 1000000), to_eye(point, seed);
            trace_light_path(settings, lambda, 0.5f, to_light, &path, &seen, nullptr);
            PartSums sums(*owned.routes, owned.group);
            CameraPath again = start(to_eye);
            trace_eye_path(settings, path, again, to_eye, sums);
            for (const CameraSplat& c : seen) light_sum[weighted] += c.value[0];
            if (t > 1) light_sum[weighted] += sums.sums()[0][0];
          }
          if (!(light_sum[0] > 0)) continue;
          std::vector<Vertex> vertices;
          LightEnd end;
          const size_t from_eye = static_cast<size_t>(t) - 1;
          if (s == 0) {
            vertices.assign(eye.vertices.begin(), eye.vertices.begin() + t - 2);
            end = eye.hits.at(t - 2);
          } else if (const auto& lit = eye.along[t - 2]; s == 1 && !lit.empty()) {
            // The sum cannot tell several light samples apart.
            if (lit.size() > 1 || (eye.direct.size() >= from_eye && eye.direct[from_eye - 1]))
              continue;
            vertices.assign(eye.vertices.begin(),
                            eye.vertices.begin() + static_cast<std::ptrdiff_t>(from_eye) - 1);
            vertices.push_back(lit[0].first);
            const DirectSample& d = lit[0].second;
            end = {d.light, d.p, d.ng, d.wi_world};
          } else {
            ASSERT_LE(from_eye, eye.vertices.size());
            vertices.assign(eye.vertices.begin(),
                            eye.vertices.begin() + static_cast<std::ptrdiff_t>(from_eye));
            for (int i = s - 2; i >= 0; --i)
              vertices.push_back(light.vertices[static_cast<size_t>(i)]);
            // The connection evaluates both ends, whatever the walks sampled there.
            if (from_eye > 0) vertices[from_eye - 1].delta = false;
            if (s > 1) vertices[from_eye].delta = false;
            end = origin;
            if (s == 1) {
              const DirectSample& d = *eye.direct[from_eye - 1];
              end = {d.light, d.p, d.ng, d.wi_world};
            }
          }
          if (vertices.empty()) {
            EXPECT_EQ(light_sum[1], light_sum[0]) << "one technique only";
            continue;
          }
          const auto line = scene->camera->connect(vertices[0].p, {0.5f, 0.5f}, 0.5f);
          ASSERT_TRUE(line);
          const double density = line->film_density * vertices[0].cosine(line->wi);
          const double expected =
              BruteForce(*scene, vertices, end, density, settings.light_paths).weight(s, lens);
          const double weight = light_sum[1] / light_sum[0];
          ++count;
          ++checked[{s, t}];
          outliers += std::abs(weight - expected) > 2e-3 + 0.01 * expected;
          worst = std::max(worst, std::abs(weight - expected));
        }
    }
  for (const auto& [technique, n] : checked)
    std::printf("(%d,%d): %d paths\n", technique.first, technique.second, n);
  std::printf("%d paths, %d outliers, largest difference %g\n", count, outliers, worst);
  EXPECT_GT(count, 2000);
  EXPECT_GE(checked.size(), 12u);
  // At grazing vertices the cosine is sensitive to rounding.
  EXPECT_LE(outliers, count / 1000);
}

TEST_P(PathPair, TechniquesAddUpToTheWhole) {
  const auto scene = scene_from_text(kView + GetParam().text);
  const OwnedRoutes owned = owned_routes(*scene, {"all=.*:bdpt", "rest=.*:path"});
  const CameraView view(*scene, {0, 0, 12, 12});
  PairSettings settings{*scene, owned};
  settings.view = &view;
  settings.max_depth = 5;
  settings.light_paths = 144;
  double largest = 0;
  for (int pixel = 0; pixel < 144; ++pixel) {
    const SobolPoint point(7);
    const auto found = [&](const TechniqueChoice& technique) {
      settings.technique = technique;
      PathSampler to_light(point, static_cast<uint64_t>(pixel) + 1000),
          to_eye(point, static_cast<uint64_t>(pixel));
      LightSubpath path;
      std::vector<CameraSplat> seen;
      const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.6f);
      trace_light_path(settings, lambda, 0.5f, to_light, &path, &seen, nullptr);
      PartSums sums(*owned.routes, owned.group);
      CameraPath camera = start_camera_path(*scene, pixel % 12, pixel / 12, to_eye, lambda, 0.5f);
      if (technique.t != 1) trace_eye_path(settings, path, camera, to_eye, sums);
      double sum = sums.sums()[0].sum();
      for (const CameraSplat& c : seen) sum += c.value.sum();
      return sum;
    };
    double sum = 0;
    for (int s = 0; s <= 7; ++s)
      for (int t = 1; t <= 7; ++t) sum += found({s, t});
    const double whole = found({});
    EXPECT_NEAR(sum, whole, 1e-5 * whole) << "pixel " << pixel;
    largest = std::max(largest, whole);
  }
  EXPECT_GT(largest, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Lights, PathPair,
    ::testing::Values(
        Lights{"lamp", kLamp},
        Lights{"lamp_and_sky", kLamp + "LightSource \"infinite\" \"rgb L\" [0.3 0.4 0.5]"},
        Lights{"points", R"(LightSource "point" "rgb I" [4 5 6] "point3 from" [1 2.5 -1]
               LightSource "spot" "rgb I" [8 5 6] "point3 from" [-1 2.5 -1] "point3 to" [0 0 0])" +
                             kLamp},
        Lights{"sun", "LightSource \"distant\" \"rgb L\" [2 2 1] \"point3 from\" [1 3 -1]" + kLamp},
        Lights{"fog", kLamp + R"(
          MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0.05 0.1 0.2]
            "rgb sigma_s" [0.9 0.6 0.4] "float g" 0.4
          Material "interface"
          AttributeBegin MediumInterface "fog" ""
            Translate -0.2 0.9 0.4 Shape "sphere" "float radius" 1.8 AttributeEnd)"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
