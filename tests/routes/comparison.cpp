// Compares compiled routes with their definition, word by word; see comparison.h.
#include "routes/comparison.h"

#include <algorithm>

namespace nephroid::oracle {
namespace {

using Kind = RouteFinding::Kind;

ClassMask mask_of_symbol(EventSymbol e) {
  return mask_of(class_of(kind_of(e)));
}

bool has(ClassMask mask, EventSymbol e) {
  return (mask & mask_of_symbol(e)) != ClassMask::kNone;
}

}  // namespace

SymbolSet all_symbols(const Routes& routes, bool media) {
  const size_t labels = routes.labels().size() + 1;
  SymbolSet all{std::vector<bool>(8 * labels), std::vector<bool>(8 * labels)};
  for (size_t label = 0; label < labels; ++label) {
    for (size_t k = 0; k < kEventKinds; ++k)
      all.events[8 * label + k] = media || static_cast<EventKind>(k) != EventKind::kH;
    for (size_t k = 0; k < kLightKinds; ++k)
      all.lights[8 * label + k] = media || static_cast<LightKind>(k) != LightKind::kMedium;
  }
  return all;
}

Comparison::Comparison(OracleRoutes& set, const Routes& routes, const SymbolSet& present)
    : set_(set), routes_(routes), present_(present) {
  const Alphabet& alphabet = set.alphabet();
  std::vector<Label> labels{0};
  for (const std::string& name : set.labels()) labels.push_back(routes.label(name));
  for (int e = 0; e < alphabet.events(); ++e)
    events_.push_back(
        event_symbol(alphabet.event_kind(e), labels[size_t(alphabet.event_label(e))]));
  for (int l = 0; l < alphabet.lights(); ++l)
    lights_.push_back(
        light_symbol(alphabet.light_kind(l), labels[size_t(alphabet.light_label(l))]));
  groups_.resize(set.routes().size());
  for (size_t g = 0; g < routes.groups().size(); ++g)
    for (const int route : routes.groups()[g].routes) groups_[size_t(route)] = g;
  for (size_t p = 0; p < routes.parts().size(); ++p)
    if (!parts_.emplace(std::pair(routes.parts()[p].route, routes.parts()[p].aovs), Part(p)).second)
      fail("two parts mean the same");

  Read none;
  none.eye = routes.start();
  const Letter eye = alphabet.eye();
  const int count = static_cast<int>(set.routes().size());
  for (int r = 0; r < count; ++r) none.routes.push_back(set.route(r).step(0, eye));
  for (int a = 0; a < static_cast<int>(set.aovs().size()); ++a)
    none.aovs.push_back(set.aov(a).step(0, eye));
  none.marked.resize(size_t(count));
  none.useful.assign(routes.groups().size(), true);
  read_.push_back(none);
}

void Comparison::fail(const std::string& what) {
  if (!failure_.empty()) return;
  failure_ = what + "\n  at " + set_.text(path_);
}

void Comparison::push(int event) {
  const size_t n = length();
  const Read before = read_[n];
  path_.events.push_back(event);
  if (read_.size() == n + 1) read_.emplace_back();
  Read& now = read_[n + 1];
  const EventSymbol e = events_[size_t(event)];
  now = before;
  now.eye = routes_.next(before.eye, e);
  const Letter plain = set_.alphabet().event(event), merged = set_.alphabet().event(event, true);
  for (size_t r = 0; r < now.routes.size(); ++r) {
    const int route = static_cast<int>(r);
    now.routes[r] = set_.route(route).step(now.routes[r], plain);
    Machine* const machine = set_.merging(route);
    if (machine == nullptr) continue;
    for (Machine::State& state : now.marked[r]) state = machine->step(state, plain);
    // The marked event may be this one: all earlier ones are read without marks.
    Machine::State state = machine->step(machine->start(), set_.alphabet().eye());
    for (size_t i = 0; i < n; ++i)
      state = machine->step(state, set_.alphabet().event(path_.events[i]));
    now.marked[r].push_back(machine->step(state, merged));
  }
  for (size_t a = 0; a < now.aovs.size(); ++a)
    now.aovs[a] = set_.aov(static_cast<int>(a)).step(now.aovs[a], plain);
  now.present = before.present && event_present(event);
  now.hair = before.hair || kind_of(e) == EventKind::kH;
  for (size_t g = 0; g < now.useful.size(); ++g)
    if (walks_from_eye(routes_.groups()[g].estimator) ||
        is_cut_anywhere(routes_.groups()[g].estimator))
      now.useful[g] = before.useful[g] && has(routes_.useful(g, before.eye, label_of(e)), e);
}

void Comparison::visit(const std::vector<int>& events, size_t length) {
  check_lights();
  if (this->length() == length) return;
  for (const int e : events) {
    push(e);
    visit(events, length);
    pop();
  }
}

void Comparison::all_words(const std::vector<int>& events, size_t length) {
  visit(events, length);
}

void Comparison::word(const std::vector<int>& events) {
  for (const int e : events) push(e);
  check_lights();
  path_.events.clear();
}

bool Comparison::present(const Path& path) const {
  bool all = present_.lights[lights_[size_t(path.light)]];
  for (const int e : path.events) all = all && event_present(e);
  return all;
}

void Comparison::check_lights() {
  const Read& read = read_[length()];
  std::vector<int> matching, aovs;
  for (int l = 0; l < set_.alphabet().lights(); ++l) {
    path_.light = l;
    ++words_;
    const Letter light = set_.alphabet().light(l);
    matching.clear();
    aovs.clear();
    int owner = -1;
    for (int r = 0; r < static_cast<int>(read.routes.size()); ++r) {
      Machine& machine = set_.route(r);
      if (!machine.accepts(machine.step(read.routes[size_t(r)], light))) continue;
      matching.push_back(r);
      if (owner < 0 && set_.can_own(r, l, read.hair)) owner = r;
    }
    for (int a = 0; a < static_cast<int>(read.aovs.size()); ++a)
      if (set_.aov(a).accepts(set_.aov(a).step(read.aovs[size_t(a)], light))) aovs.push_back(a);
    vertices_.clear();
    if (Machine* machine = owner < 0 ? nullptr : set_.merging(owner))
      for (size_t k = 0; k < length(); ++k)
        if (machine->accepts(machine->step(read.marked[size_t(owner)][k], light)))
          vertices_.push_back(k);

    const Part part = routes_.owner(read.eye, lights_[size_t(l)]);
    const auto expected = parts_.find({owner, aovs});
    if (owner < 0 ? part != kNoPart : expected == parts_.end() || expected->second != part) {
      const auto name = [&](int r) { return r < 0 ? "none" : set_.routes()[size_t(r)].name; };
      fail("the owner is " + name(part == kNoPart ? -1 : routes_.parts()[part].route) +
           " or the layers are wrong, expected " + name(owner));
    }
    check_light_side(owner, part);
    if (read.present && present_.lights[lights_[size_t(l)]]) {
      check_useful(owner, part);
      note_defects(owner, matching);
    }
  }
}

void Comparison::check_light_side(int route, Part part) {
  LightState light = routes_.emitted(lights_[size_t(path_.light)]);
  for (size_t k = length(); k > 0; --k) {
    const EventSymbol e = symbol(k - 1);
    if (routes_.meet(read_[k].eye, light) != part)
      fail("another owner when the walks meet at vertex " + std::to_string(k));
    const bool merged = std::find(vertices_.begin(), vertices_.end(), k - 1) != vertices_.end();
    if (routes_.meet(routes_.merge(read_[k - 1].eye, e), light) != (merged ? part : kNoPart))
      fail("merging at vertex " + std::to_string(k) + (merged ? " is not" : " is") +
           " allowed by " + (route < 0 ? "none" : set_.routes()[size_t(route)].name));
    light = routes_.light_next(light, e);
  }
  if (routes_.meet(read_[0].eye, light) != part) fail("another owner at the eye");
}

void Comparison::check_useful(int route, Part part) {
  if (route < 0) return;
  const size_t g = group_of(route), n = length();
  if (!routes_.owns(g, part)) fail("the part is not the group's");
  if (!set_.can_sample(route, path_, vertices_.size())) return;
  const EstimatorTraits* const estimator = set_.routes()[size_t(route)].estimator;
  if (walks_from_eye(estimator) && !(read_[n].useful[g] && routes_.ends(g, read_[n].eye)))
    fail("the camera walk ends too early");
  if (walks_from_eye(estimator)) return;

  const LightState emitted = routes_.emitted(lights_[size_t(path_.light)]);
  LightState light = emitted;
  if (is_cut_anywhere(estimator)) {
    if (!read_[n].useful[g]) fail("the eye's walk ends too early");
    for (size_t i = n; i-- > 0; light = routes_.light_next(light, symbol(i)))
      if (!has(routes_.useful_from_light(g, light, label_of(symbol(i))), symbol(i)))
        fail("the light's walk ends too early");
    return;
  }
  if (set_.type(route).merges) {
    const size_t vertex = vertices_.front();
    for (size_t i = 0; i <= vertex; ++i) {
      const EyeState eye = read_[i].eye;
      const Label label = label_of(symbol(i));
      if (!has(i < vertex ? routes_.useful_before_merge(g, eye, label)
                          : routes_.merges(g, eye, label),
               symbol(i)))
        fail("the camera walk does not reach the merge vertex");
    }
    for (size_t i = n; i-- > vertex;) {
      const Label label = label_of(symbol(i));
      if (!has(i > vertex ? routes_.useful_before_deposit(g, light, label)
                          : routes_.deposits(g, light, label),
               symbol(i)))
        fail("the photon does not reach the merge vertex");
      light = routes_.light_next(light, symbol(i));
    }
  }
  if (!connects_lights(estimator) || n == 0) return;
  const EventKind first = kind_of(symbol(0));
  if (first == EventKind::kSR || first == EventKind::kST) return;
  light = emitted;
  for (size_t i = n; i-- > 0;) {
    const Label label = label_of(symbol(i));
    if (!has(i > 0 ? routes_.useful_before_connection(g, light, label)
                   : routes_.connects(g, light, label),
             symbol(i)))
      fail("the light walk is not connected to the camera");
    light = routes_.light_next(light, symbol(i));
  }
}

void Comparison::note_defects(int route, const std::vector<int>& matching) {
  const bool glow =
      set_.alphabet().light_kind(path_.light) == LightKind::kMedium || read_[length()].hair;
  if (route < 0) {
    (glow ? dark_medium_ : hole_) = true;
    return;
  }
  const int last = static_cast<int>(set_.routes().size()) - 1;
  if (!glow && matching.size() > 1)
    for (size_t j = 1; j < matching.size(); ++j)
      if (matching[j] != last) overlaps_.emplace(matching[0], matching[j]);
  const auto [it, is_first] = shortest_.emplace(route, length());
  if (!is_first) it->second = std::min(it->second, length());
  if (set_.type(route).merges) {
    if (vertices_.size() > 1) defects_.emplace(Kind::kTwoMergeVertices, route);
    if (vertices_.empty() && defects_.count({Kind::kNoMergeVertex, route}) == 0 &&
        !set_.facts(path_).marked_twice)
      defects_.emplace(Kind::kNoMergeVertex, route);
  } else if (!set_.can_sample(route, path_, 0) && set_.somebody_can_sample(path_)) {
    defects_.emplace(Kind::kNeverSampled, route);
  }
}

bool Comparison::is_defect(Kind kind, const Path& path) {
  if (!present(path)) return false;
  const PathFacts facts = set_.facts(path);
  const int last = static_cast<int>(set_.routes().size()) - 1;
  if (kind == Kind::kHole) return !facts.owner;
  if (kind == Kind::kOverlap) return facts.matching.size() > 1 && facts.matching[1] != last;
  if (!facts.owner) return false;
  const bool merges = set_.type(*facts.owner).merges;
  if (kind == Kind::kNoMergeVertex) return merges && facts.merge_vertices.empty();
  if (kind == Kind::kTwoMergeVertices)
    return merges && (facts.merge_vertices.size() > 1 || facts.marked_twice);
  return !set_.can_sample(*facts.owner, path, facts.merge_vertices.size());
}

void Comparison::findings(const RouteCompilation& compilation) {
  const auto names = [&](const RouteFinding& f, int r) {
    return f.message.find(set_.routes()[size_t(r)].name) != std::string::npos;
  };
  const auto found = [&](Kind kind, std::vector<int> routes) {
    for (const RouteFinding& f : compilation.findings)
      if (f.kind == kind &&
          std::all_of(routes.begin(), routes.end(), [&](int r) { return names(f, r); }))
        return true;
    return false;
  };
  path_ = {};
  for (const auto& [i, j] : overlaps_)
    if (!found(Kind::kOverlap, {i, j}))
      fail("no overlap of routes " + std::to_string(i) + " and " + std::to_string(j) + " is found");
  if (hole_ && !found(Kind::kHole, {})) fail("no hole is found");
  if (dark_medium_ && !found(Kind::kHole, {}) && !found(Kind::kNeverSampled, {}))
    fail("light from a medium that nobody renders is not found");
  for (const auto& [kind, route] : defects_)
    if (!found(kind, {route}))
      fail("finding " + std::to_string(static_cast<int>(kind)) + " is missing for route " +
           std::to_string(route));

  bool warnings = false;
  for (const RouteFinding& f : compilation.findings) {
    if (f.is_error && warnings) fail("an error comes after a warning: " + f.message);
    warnings = warnings || !f.is_error;
    if (f.is_error != (f.kind != Kind::kOverlap && f.kind != Kind::kNeverSampled))
      fail("error or warning? " + f.message);
    if (f.kind == Kind::kUnreachable) {
      bool somebody = false;
      for (int r = 0; r < static_cast<int>(set_.routes().size()); ++r)
        somebody = somebody || (names(f, r) && shortest_.count(r) == 0);
      if (!somebody) fail("the route is reachable: " + f.message);
      continue;
    }
    if (f.message.find(f.witness) == std::string::npos) fail("no witness in: " + f.message);
    const std::vector<Path> paths = set_.paths_of(f.witness);
    if (std::none_of(paths.begin(), paths.end(),
                     [&](const Path& path) { return is_defect(f.kind, path); }))
      fail("the witness '" + f.witness + "' is none: " + f.message);
  }
  for (const auto& entry : shortest_) {
    const int route = entry.first;
    const size_t events = entry.second;
    const std::vector<Path> paths = set_.paths_of(compilation.examples[size_t(route)]);
    const auto owned = [&](const Path& path) {
      return present(path) && set_.facts(path).owner == route;
    };
    if (found(Kind::kUnreachable, {route})) continue;  // unreachable routes were checked above
    if (std::none_of(paths.begin(), paths.end(), owned) || paths[0].events.size() > events)
      fail("'" + compilation.examples[size_t(route)] + "' is not a shortest path of route " +
           std::to_string(route));
  }
}

}  // namespace nephroid::oracle
