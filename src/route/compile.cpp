// The pipeline from expressions to tables: trees, a nondeterministic automaton with each route once
// without and once with its marks, subset construction, parts, reversal, tables, proof.
#include "route/compile.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/errors.h"
#include "route/expression_error.h"
#include "route/light_side.h"
#include "route/owners.h"
#include "route/proof.h"
#include "route/route_text.h"

namespace nephroid {
namespace {

constexpr size_t kMaxLabels = 1000;
constexpr size_t kMaxTableBytes = size_t{64} << 20;

// The merge vertex of a route without '@': the first D or G from the eye.
constexpr const char* kDefaultMark = "C[SV]*[DG]@.*";

struct Trees {
  std::vector<Expression> routes, aovs;
  Expression default_mark;
};

ExpressionSource named_source(const ExpressionSource& source, const std::string& expression,
                              const char* what, const std::string& name) {
  ExpressionSource s = source_of(source, expression);
  if (source.text.empty()) s.where = std::string(what) + " " + name;
  return s;
}

Trees parse_all(std::span<const RouteDefinition> routes, std::span<const AovDefinition> aovs) {
  if (routes.empty()) throw UsageError("expected at least one route, such as rest=.*:path");
  Trees trees;
  std::set<std::string> names;
  const auto check_name = [&](const std::string& name, const ExpressionSource& source) {
    const ExpressionSource at_name{
        source.where, source.text.empty() ? name : source.text,
        source.text.empty() ? 0 : std::min(source.text.find(name), source.text.size())};
    check_layer_name(name, {at_name.where.empty() ? "route" : at_name.where, name, 0});
    if (!names.insert(name).second)
      throw expression_error(
          at_name, at_name.column,
          "the name '" + name + "' is taken, expected one that no route and no AOV has");
  };
  for (const RouteDefinition& r : routes) {
    check_name(r.name, r.source);
    trees.routes.push_back(
        parse_checked(r.expression, named_source(r.source, r.expression, "route", r.name)));
  }
  for (const AovDefinition& a : aovs) {
    check_name(a.name, a.source);
    trees.aovs.push_back(
        parse_checked(a.expression, named_source(a.source, a.expression, "AOV", a.name)));
  }
  trees.default_mark = parse_expression(kDefaultMark, {"default mark", kDefaultMark, 0});
  return trees;
}

std::vector<std::string> labels_of(const Trees& trees) {
  std::vector<std::string> labels;
  for (const Expression& e : trees.routes) collect_labels(e, labels);
  for (const Expression& e : trees.aovs) collect_labels(e, labels);
  if (labels.size() > kMaxLabels)
    throw UsageError("the routes mention " + std::to_string(labels.size()) +
                     " labels, expected at most " + std::to_string(kMaxLabels));
  return labels;
}

// One automaton with all expressions; `trees` must outlive the result.
Nfa copy_all(const Trees& trees, std::span<const RouteDefinition> routes,
             std::span<const AovDefinition> aovs, ExpressionCopies& copies) {
  Nfa nfa;
  for (size_t r = 0; r < routes.size(); ++r)
    nfa.add(trees.routes[r], source_of(routes[r].source, routes[r].expression));
  for (size_t a = 0; a < aovs.size(); ++a)
    nfa.add(trees.aovs[a], source_of(aovs[a].source, aovs[a].expression));
  copies.routes = routes.size();
  copies.aovs = aovs.size();
  const int default_mark = static_cast<int>(nfa.copies());
  nfa.add(trees.default_mark, {});
  for (size_t r = 0; r < routes.size(); ++r) {
    copies.marked_copy.push_back(-1);
    if (!routes[r].estimator->merges) continue;
    const bool has_marks = has_merge_mark(trees.routes[r]);
    copies.marked_copy[r] = has_marks ? static_cast<int>(nfa.copies()) : default_mark;
    if (has_marks) nfa.add(trees.routes[r], source_of(routes[r].source, routes[r].expression));
  }
  return nfa;
}

// Columns of numbers that are no symbol match no route.
RouteTables write_out(const Automaton& eye, const LightSide& light, const SymbolClasses& classes) {
  RouteTables t;
  t.eye_states = eye.states();
  t.light_states = light.meet.size();
  t.event_symbols = classes.event_class.size();
  t.light_symbols = classes.light_class.size();
  t.start = static_cast<EyeState>(eye.start);
  const size_t cells = (2 * t.eye_states + t.light_states) * t.event_symbols;
  if (2 * cells > kMaxTableBytes)
    throw UsageError("the routes are too complex: their tables would have " +
                     std::to_string(cells) + " entries, expected fewer labels or repetitions");

  const auto dead_light = [&] {
    for (size_t s = 0; s < t.light_states; ++s)
      if (std::all_of(light.meet[s].begin(), light.meet[s].end(),
                      [](Part p) { return p == kNoPart; }))
        return s;
    return size_t{0};
  }();
  std::vector<uint16_t> next, merge_next, emitted, light_next;
  for (size_t s = 0; s < t.eye_states; ++s) {
    const int state = static_cast<int>(s);
    for (const int e : classes.event_class) {
      const bool exists = e != SymbolClasses::kNone;
      next.push_back(static_cast<uint16_t>(exists ? eye.after(state, e) : eye.dead));
      merge_next.push_back(static_cast<uint16_t>(exists ? eye.after_merge(state, e) : eye.dead));
    }
    for (const int l : classes.light_class)
      t.owner.push_back(l == SymbolClasses::kNone ? kNoPart : static_cast<Part>(eye.at(state, l)));
    for (size_t c = 0; c < t.light_states; ++c) t.meet.push_back(light.meet[c][s]);
  }
  for (const int l : classes.light_class)
    emitted.push_back(static_cast<uint16_t>(
        l == SymbolClasses::kNone ? dead_light : static_cast<size_t>(light.emitted[l])));
  for (size_t s = 0; s < t.light_states; ++s)
    for (const int e : classes.event_class)
      light_next.push_back(static_cast<uint16_t>(
          e == SymbolClasses::kNone
              ? dead_light
              : static_cast<size_t>(light.next[s * eye.events + static_cast<size_t>(e)])));
  t.eye_next = NumberTable(next);
  t.merge_next = NumberTable(merge_next);
  t.emitted = NumberTable(emitted);
  t.light_next = NumberTable(light_next);
  return t;
}

}  // namespace

RouteCompilation compile_routes(std::span<const RouteDefinition> routes,
                                std::span<const AovDefinition> aovs, const SymbolSet* symbols,
                                bool camera_connects) {
  const Trees trees = parse_all(routes, aovs);
  std::vector<std::string> labels = labels_of(trees);
  ExpressionCopies copies;
  const Nfa nfa = copy_all(trees, routes, aovs, copies);
  const SymbolClasses classes = classify_symbols(nfa.atoms, labels);
  const MatchAutomaton matches = determinise(nfa, classes, copies);
  const PartAutomaton parts = divide_into_parts(matches, classes, routes, aovs);
  Proof proof = prove({routes, labels, classes, matches, parts, symbols, camera_connects});
  proof.aov_matches.resize(aovs.size());
  RouteTables tables = write_out(parts.automaton, reverse(parts.automaton), classes);
  Routes compiled({routes.begin(), routes.end()}, {aovs.begin(), aovs.end()}, parts.parts,
                  std::move(labels), std::move(tables));
  return {symbols ? compiled.restricted_to(*symbols) : std::move(compiled),
          std::move(proof.findings), std::move(proof.examples), std::move(proof.aov_matches),
          std::move(proof.part_matches)};
}

Routes checked_routes(RouteCompilation compilation, bool strict) {
  for (const RouteFinding& f : compilation.findings)
    if (f.is_error) throw UsageError(f.message);
  for (const RouteFinding& f : compilation.findings)
    if (strict && f.kind == RouteFinding::Kind::kOverlap) throw UsageError(f.message);
  return std::move(compilation.routes);
}

std::vector<std::string> mentioned_labels(std::span<const RouteDefinition> routes,
                                          std::span<const AovDefinition> aovs) {
  return labels_of(parse_all(routes, aovs));
}

}  // namespace nephroid
