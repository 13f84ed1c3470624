#include "integrator/path/specular_tree.h"

#include <algorithm>

#include "transport/walk_symbols.h"

namespace nephroid {

namespace {

/// A branch that carries less than this Russian roulette threshold goes one way only.
constexpr float kWindow = 1.0f / 8;
/// Limit of nested branchings; bounds the tree where nothing absorbs.
constexpr int kMaxBranchings = 16;

bool owns_light_behind_specular(const OwnedRoutes& owned) {
  const Routes& routes = *owned.routes;
  std::vector<EyeState> open{routes.start()};
  std::vector<bool> seen(open.front() + 1, true);
  while (!open.empty()) {
    const EyeState eye = open.back();
    open.pop_back();
    for (size_t l = 0; l <= routes.labels().size(); ++l) {
      const Label label = static_cast<Label>(l);
      if (!contains(routes.useful(owned.group, eye, label), EventClass::kSpecular)) continue;
      for (const bool transmitted : {false, true}) {
        const EyeState next =
            routes.next(eye, event_symbol(EventClass::kSpecular, transmitted, label));
        if (routes.ends(owned.group, next)) return true;
        if (next >= seen.size()) seen.resize(next + 1, false);
        if (!seen[next]) open.push_back(next);
        seen[next] = true;
      }
    }
  }
  return false;
}

}  // namespace

/// Follows one branch.
class SpecularTree::Visitor {
 public:
  static constexpr bool kEndsAtBranches = true;

  Visitor(const SpecularTree& tree, EyeState eye, int branchings, std::vector<Light>& found,
          PathRecorder* recorder)
      : tree_(tree),
        routes_(*tree.owned_.routes),
        symbols_(*tree.owned_.symbols),
        group_(tree.owned_.group),
        eye_(eye),
        branchings_(branchings),
        found_(found),
        recorder_(recorder) {}

  void escape(const Walk& walk) {
    if (!routes_.ends(group_, eye_)) return;
    for (const int i : tree_.scene_.light_sampler->infinite_lights()) {
      const Part part = routes_.owner(eye_, symbols_.light(i));
      if (!routes_.owns(group_, part)) continue;
      const nephroid::Light& light = *tree_.scene_.lights[i];
      add(walk, part, light.radiance_at_infinity(walk.previous_p, walk.ray.d, walk.lambda),
          end_at_infinity(tree_.scene_, i, walk.ray.o, walk.ray.d));
    }
  }

  void emitter(const Walk& walk, const SurfaceInteraction& hit, const nephroid::Light& light) {
    const Part part = routes_.owner(eye_, symbols_.light(hit.area_light));
    if (!routes_.owns(group_, part)) return;
    add(walk, part, light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda),
        {hit.area_light, -1, hit.p});
  }

  void medium_emission(const Medium&, const SampledSpectrum&) {}

  ClassMask useful(const WalkVertex& v) const {
    return routes_.useful(group_, eye_, label_at(symbols_, v)) & ClassMask::kSpecular;
  }
  bool scatters_in(const Medium&) const { return false; }
  bool looks_under_surfaces() const { return false; }
  void vertex(const Walk&, const WalkVertex& v, PathSampler&) {
    if (recorder_ != nullptr) recorder_->walk.arrive(v.surface.p, v.subsurface_exit);
  }
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}

  bool branches(const Walk& walk) const {
    return branchings_ < kMaxBranchings && walk.carried() >= kWindow;
  }
  void branch(const Walk& way, const WalkEvent& event, PathSampler& sampler) {
    const RecordedBranch recorded(record(), event);
    Visitor visitor(tree_, routes_.next(eye_, symbol_of(symbols_, event)), branchings_ + 1, found_,
                    recorder_);
    rays_ += visitor.run(way, sampler);
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    if (recorder_ != nullptr) recorder_->walk.scatter(event);
    eye_ = routes_.next(eye_, symbol_of(symbols_, event));
    return walk.delta;
  }

  uint64_t run(Walk way, PathSampler& sampler) {
    random_walk(tree_.scene_, TransportMode::kRadiance, tree_.max_events_, way, sampler, *this);
    return rays_ + way.rays;
  }

 private:
  WalkRecord* record() const { return recorder_ != nullptr ? &recorder_->walk : nullptr; }

  void add(const Walk& walk, Part part, const SampledSpectrum& radiance, const PathEnd& end) {
    if (walk.events == 0 || radiance.is_black()) return;
    found_.push_back({part, symbols_.lamp(end.light),
                      walk.throughput * radiance * (1.0f / walk.density.u_mean), walk.lambda.left(),
                      std::min(1.0f, walk.carried())});
    if (recorder_ != nullptr)
      recorder_->meet({part, Technique::kMeetByMirrors, found_.back().whole()}, end);
  }

  const SpecularTree& tree_;
  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  EyeState eye_;
  const int branchings_;
  std::vector<Light>& found_;
  PathRecorder* const recorder_;
  uint64_t rays_ = 0;
};

SpecularTree::SpecularTree(const Scene& scene, const OwnedRoutes& owned, int max_events)
    : scene_(scene),
      owned_(owned),
      max_events_(max_events),
      finds_something_(owns_light_behind_specular(owned)) {}

uint64_t SpecularTree::look(const Walk& walk, PathSampler& sampler, std::vector<Light>& found,
                            PathRecorder* recorder) const {
  Walk root = walk;
  root.roulette_threshold = kWindow;
  return Visitor(*this, owned_.routes->start(), 0, found, recorder).run(root, sampler);
}

uint64_t SpecularTree::follow(Walk branch, EyeState eye, PathSampler& sampler,
                              std::vector<Light>& found, PathRecorder* recorder) const {
  branch.roulette_threshold = kWindow;
  return Visitor(*this, eye, 1, found, recorder).run(branch, sampler);
}

}  // namespace nephroid
