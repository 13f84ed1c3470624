// The definition of a route set; see oracle_routes.h.
#include "routes/oracle_routes.h"

#include <algorithm>
#include <utility>

#include "estimators.h"

namespace nephroid::oracle {
namespace {

constexpr unsigned bit(EventKind kind) {
  return 1u << static_cast<int>(kind);
}
constexpr unsigned bit(LightKind kind) {
  return 1u << static_cast<int>(kind);
}

/// Event kinds of the class that the letter names; '.' is any class.
unsigned class_bits(char letter) {
  switch (letter) {
    case 'D':
      return bit(EventKind::kDR) | bit(EventKind::kDT);
    case 'G':
      return bit(EventKind::kGR) | bit(EventKind::kGT);
    case 'S':
      return bit(EventKind::kSR) | bit(EventKind::kST);
    case 'V':
      return bit(EventKind::kV);
    case 'H':
      return bit(EventKind::kH);
    case '.':
      return kAllEvents;
    default:
      return 0;
  }
}

/// Event kinds on that side of a surface; '.' is any side.
unsigned side_bits(char letter) {
  const unsigned t = bit(EventKind::kDT) | bit(EventKind::kGT) | bit(EventKind::kST);
  switch (letter) {
    case 'R':
      return (kRoughEvents & ~t) | bit(EventKind::kSR);
    case 'T':
      return t;
    case '.':
      return kAllEvents;
    default:
      return 0;
  }
}

unsigned light_bits(char letter) {
  switch (letter) {
    case 'L':
      return kAllLights;
    case 'O':
      return bit(LightKind::kShape);
    case 'B':
      return bit(LightKind::kEnvironment) | bit(LightKind::kDistant);
    case 'M':
      return bit(LightKind::kMedium);
    default:
      return 0;
  }
}

/// True if the machine accepts the path with marks at these events.
bool accepts(Machine& machine, const Alphabet& alphabet, const Path& path,
             const std::vector<size_t>& marks) {
  Machine::State state = machine.step(machine.start(), alphabet.eye());
  for (size_t i = 0; i < path.events.size(); ++i)
    state = machine.step(
        state, alphabet.event(path.events[i], std::count(marks.begin(), marks.end(), i) != 0));
  return machine.accepts(machine.step(state, alphabet.light(path.light)));
}

}  // namespace

std::optional<Atom> atom_of(const std::string& text, const std::vector<std::string>& labels) {
  Atom atom;
  atom.text = text;
  if (text.size() == 1) {
    const char c = text[0];
    atom.eye = c == 'C' || c == '.';
    atom.events = class_bits(c) | (c == '.' ? 0u : side_bits(c));
    atom.lights = c == '.' ? kAllLights : light_bits(c);
  } else if (text.size() >= 3 && text.front() == '<' && text.back() == '>') {
    std::string inside = text.substr(1, text.size() - 2);
    if (const size_t quote = inside.find('\''); quote != std::string::npos) {
      const std::string name = inside.substr(quote + 1, inside.rfind('\'') - quote - 1);
      const auto it = std::find(labels.begin(), labels.end(), name);
      atom.label = it == labels.end() ? 0 : static_cast<int>(it - labels.begin()) + 1;
      inside.erase(quote);
    }
    if (inside.empty() || inside.size() > 2) return {};
    const char first = inside[0], second = inside.size() == 2 ? inside[1] : '.';
    if (first == 'V' || first == 'H')
      atom.events = second == '.' ? class_bits(first) : 0;
    else if (light_bits(first) != 0)
      atom.lights = second == '.' ? light_bits(first) : 0;
    else if (side_bits(first) != 0)
      atom.events = side_bits(first) & class_bits(second);
    else
      atom.events = inside.size() == 1 ? class_bits(first) : 0;
  }
  if (!atom.eye && atom.events == 0 && atom.lights == 0) return {};
  return atom;
}

Atom set_of(std::string_view letters, bool complement) {
  Atom set;
  for (const char c : letters) {
    const Atom letter = *atom_of(std::string(1, c), {});
    set.eye = set.eye || letter.eye;
    set.events |= letter.events;
    set.lights |= letter.lights;
  }
  if (complement) {
    set.eye = !set.eye;
    set.events = kAllEvents & ~set.events;
    set.lights = kAllLights & ~set.lights;
  }
  set.text = (complement ? "[^" : "[") + std::string(letters) + "]";
  return set;
}

Tree first_rough_event() {
  Atom eye, before, here, any;
  eye.eye = true;
  before.events = kAllEvents & ~kRoughEvents;
  here.events = kRoughEvents;
  here.marked = true;
  any.events = kAllEvents;
  any.lights = kAllLights;
  return Tree::sequence({Tree::of(eye), Tree::repeat(Tree::of(before), 0, -1), Tree::of(here),
                         Tree::repeat(Tree::of(any), 0, -1)});
}

OracleRoutes::OracleRoutes(std::vector<OracleRoute> routes, std::vector<OracleRoute> aovs,
                           std::vector<std::string> labels)
    : alphabet_(static_cast<int>(labels.size())),
      routes_(std::move(routes)),
      aovs_(std::move(aovs)),
      labels_(std::move(labels)) {
  for (const OracleRoute& route : routes_) {
    plain_.emplace_back(route.expression, alphabet_, Atom::Marks::kIgnore);
    merging_.emplace_back();
    if (route.estimator->merges)
      merging_.back().emplace(route.expression.has_marks() ? route.expression : first_rough_event(),
                              alphabet_, Atom::Marks::kObey);
  }
  for (const OracleRoute& aov : aovs_)
    layers_.emplace_back(aov.expression, alphabet_, Atom::Marks::kIgnore);
}

bool OracleRoutes::touches_hair(const Path& path) const {
  return std::any_of(path.events.begin(), path.events.end(),
                     [&](int e) { return alphabet_.event_kind(e) == EventKind::kH; });
}

bool OracleRoutes::somebody_can_sample(const Path& path) const {
  const auto specular = [&](int e) {
    const EventKind k = alphabet_.event_kind(e);
    return k == EventKind::kSR || k == EventKind::kST;
  };
  const LightKind light = alphabet_.light_kind(path.light);
  return (light != LightKind::kPoint && light != LightKind::kDistant) ||
         !std::all_of(path.events.begin(), path.events.end(), specular);
}

bool OracleRoutes::can_sample(int route, const Path& path, size_t merge_vertices) const {
  const auto kind_at = [&](size_t i) { return alphabet_.event_kind(path.events[i]); };
  const auto specular = [](EventKind k) { return k == EventKind::kSR || k == EventKind::kST; };
  const LightKind light = alphabet_.light_kind(path.light);
  const size_t n = path.events.size();
  if (type(route).merges) return merge_vertices == 1;
  if (is_one_of(routes_[size_t(route)].estimator, {"lighttrace"}))
    return n == 0 ? light == LightKind::kShape : !specular(kind_at(0));
  if (is_one_of(routes_[size_t(route)].estimator, {"pointlights"})) {
    // Found by connection if the event after the first D or G is also D or G.
    const auto rough = [](EventKind k) {
      return class_of(k) == EventClass::kDiffuse || class_of(k) == EventClass::kGlossy;
    };
    size_t first = 0;
    while (first < n && !rough(kind_at(first))) ++first;
    if (first + 1 < n && rough(kind_at(first + 1))) return true;
  }
  const bool no_area = light == LightKind::kPoint || light == LightKind::kDistant;
  const EstimatorTraits* const estimator = routes_[size_t(route)].estimator;
  const bool connects = is_one_of(estimator, {"bdpt", "vcm", "mlt"});
  // path+photons merges only photons that passed an S. All words that it cannot find otherwise
  // contain one.
  const bool merges = is_one_of(estimator, {"vcm", "bpm", "path+photons"});
  const bool merges_in_media = is_one_of(estimator, {"path+photons"});
  bool only_specular = true;
  if (no_area && connects && n > 0 && !specular(kind_at(0))) return true;
  for (size_t i = 0; no_area && i < n; ++i) {
    const EventKind k = kind_at(i);
    if (connects && i > 0 && !specular(k) && !specular(kind_at(i - 1))) return true;
    if (merges_in_media && only_specular && class_of(k) == EventClass::kVolume) return true;
    only_specular = only_specular && specular(k);
    if (merges && (kRoughEvents >> static_cast<int>(k) & 1u) != 0) return true;
  }
  return !(no_area && (n == 0 || specular(kind_at(n - 1))));
}

PathFacts OracleRoutes::facts(const Path& path) {
  PathFacts facts;
  for (int r = 0; r < static_cast<int>(routes_.size()); ++r) {
    if (!accepts(route(r), alphabet_, path, {})) continue;
    facts.matching.push_back(r);
    if (!facts.owner && can_own(r, path.light, touches_hair(path))) facts.owner = r;
  }
  for (int a = 0; a < static_cast<int>(aovs_.size()); ++a)
    if (accepts(aov(a), alphabet_, path, {})) facts.aovs.push_back(a);
  if (Machine* machine = facts.owner ? merging(*facts.owner) : nullptr)
    for (size_t i = 0; i < path.events.size(); ++i) {
      if (accepts(*machine, alphabet_, path, {i})) facts.merge_vertices.push_back(i);
      for (size_t k = 0; k < i; ++k)
        facts.marked_twice = facts.marked_twice || accepts(*machine, alphabet_, path, {k, i});
    }
  return facts;
}

std::vector<Path> OracleRoutes::paths_of(const std::string& word, size_t most) const {
  std::vector<Path> paths(1);
  // Letters are separated by spaces; a space in a label belongs to the label.
  std::vector<std::string> tokens(1);
  bool in_label = false;
  for (const char c : word) {
    in_label = in_label != (c == '\'');
    if (c != ' ' || in_label)
      tokens.back() += c;
    else if (!tokens.back().empty())
      tokens.emplace_back();
  }
  if (tokens.size() < 2 || tokens[0] != "C") return {};
  for (size_t t = 1; t < tokens.size(); ++t) {
    const bool is_light = t + 1 == tokens.size();
    const auto atom = atom_of(tokens[t], labels_);
    if (!atom) return {};
    std::vector<Path> longer;
    for (const Path& path : paths)
      for (int i = 0; i < (is_light ? alphabet_.lights() : alphabet_.events()); ++i) {
        if (!atom->matches(alphabet_, is_light ? alphabet_.light(i) : alphabet_.event(i),
                           Atom::Marks::kIgnore))
          continue;
        if (longer.size() == most) break;
        longer.push_back(path);
        if (is_light)
          longer.back().light = i;
        else
          longer.back().events.push_back(i);
      }
    paths = std::move(longer);
  }
  return paths;
}

std::string OracleRoutes::text(const Path& path) const {
  const auto label = [&](int i) {
    return i == 0 ? std::string() : "'" + labels_[size_t(i) - 1] + "'";
  };
  static const char* const kEvents[] = {"RD", "TD", "RG", "TG", "RS", "TS", "V."};
  static const char* const kLights[] = {"shape", "environment", "distant", "point", "medium"};
  std::string out = "C";
  for (const int e : path.events)
    out += std::string(" <") + kEvents[static_cast<int>(alphabet_.event_kind(e))] +
           label(alphabet_.event_label(e)) + ">";
  return out + " " + kLights[static_cast<int>(alphabet_.light_kind(path.light))] +
         label(alphabet_.light_label(path.light));
}

}  // namespace nephroid::oracle
