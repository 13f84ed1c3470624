// Random route sets; see random_routes.h. They use the generator's raw numbers: distributions of
// the standard library differ between machines.
#include "routes/random_routes.h"

#include <iterator>
#include <utility>

#include "estimators.h"

namespace nephroid::oracle {
namespace {

/// <X[..]'label'> with a set of classes.
Atom classes_of(char side, std::string_view letters, const std::string& name, int label) {
  Atom atom;
  for (const char c : letters)
    atom.events |= atom_of(std::string("<") + side + c + ">", {})->events;
  atom.text = std::string("<") + side + "[" + std::string(letters) + "]" +
              (label > 0 ? "'" + name + "'" : "") + ">";
  atom.label = label > 0 ? label : -1;
  return atom;
}

}  // namespace

RandomRoutes::RandomRoutes(uint32_t seed, std::vector<std::string> labels)
    : random_(seed), labels_(std::move(labels)) {}

Atom RandomRoutes::event() {
  static const char* const kLetters[] = {"D", "D", "D", "S", "S", "S", "S",
                                         "G", "G", "V", "H", "R", "T", "."};
  static const char* const kPairs[] = {"<RD>", "<TS>", "<RS>", "<.D>", "<.S>", "<T.>",
                                       "<R.>", "<..>", "<TG>", "<TD>", "<V>",  "<V.>"};
  static const char* const kSets[] = {"DG", "SV", "DSG", "RV", "DT", "SD"};
  static const char* const kOthers[] = {"S", "D", "DG", "V", "H", "T", "SL", "O", "C"};
  const int choice = below(100);
  if (!labels_.empty() && choice < 35) {
    const int label = 1 + below(static_cast<int>(labels_.size()));
    const std::string& name = labels_[static_cast<size_t>(label) - 1];
    static const char* const kLabelled[] = {"..", ".S", "TS", ".D", "RD", "V.", "V", "T."};
    if (chance(20)) return classes_of(chance(50) ? '.' : 'R', "DG", name, label);
    return *atom_of(std::string("<") + kLabelled[below(8)] + "'" + name + "'>", labels_);
  }
  if (choice < 60) return *atom_of(kLetters[below(13)], {});
  if (choice < 72) return *atom_of(kPairs[below(12)], {});
  if (choice < 76) return classes_of(chance(50) ? '.' : 'T', chance(50) ? "DG" : "SG", "", 0);
  if (choice < 88) return set_of(kSets[below(6)], false);
  return set_of(kOthers[below(8)], true);
}

Atom RandomRoutes::rough() {
  static const char* const kAtoms[] = {"D", "D", "D", "G", ".", "R", "<.D>", "<R.>", "<..>"};
  if (chance(25)) return set_of("DG", false);
  if (!labels_.empty() && chance(20)) return *atom_of("<.D'" + labels_[0] + "'>", labels_);
  return *atom_of(kAtoms[below(9)], {});
}

Atom RandomRoutes::light() {
  static const char* const kLetters[] = {"L", "L", "L", "L", "L", "O", "O", "B", "M", "."};
  if (!labels_.empty() && chance(35)) {
    static const char* const kKinds[] = {"<L.'", "<O.'", "<B.'", "<L'", "<M.'"};
    return *atom_of(
        kKinds[below(5)] + labels_[size_t(below(static_cast<int>(labels_.size())))] + "'>",
        labels_);
  }
  if (chance(15)) return set_of(chance(50) ? "OB" : "MO", false);
  if (chance(10)) return set_of(chance(50) ? "O" : "BM", true);
  return *atom_of(kLetters[below(10)], {});
}

Tree RandomRoutes::repeated(Tree tree) {
  switch (below(9)) {
    case 0:
    case 1:
      return Tree::repeat(std::move(tree), 0, -1);
    case 2:
    case 3:
      return Tree::repeat(std::move(tree), 1, -1);
    case 4:
      return Tree::repeat(std::move(tree), 0, 1);
    case 5:
      return Tree::repeat(std::move(tree), 2, 2);
    case 6:
      return Tree::repeat(std::move(tree), 1, 3);
    case 7:
      return Tree::repeat(std::move(tree), 2, -1);
    default:
      return tree;
  }
}

Tree RandomRoutes::events(int depth) {
  if (depth == 0 || chance(45)) {
    Tree atom = Tree::of(event());
    return chance(45) ? repeated(std::move(atom)) : atom;
  }
  std::vector<Tree> parts;
  for (int n = 1 + below(3); n > 0; --n) parts.push_back(events(depth - 1));
  if (chance(30)) parts.push_back(events(0));
  Tree tree = parts.size() > 1 && chance(35) ? Tree::choice(std::move(parts))
                                             : Tree::sequence(std::move(parts));
  return chance(20) ? repeated(std::move(tree)) : tree;
}

Tree RandomRoutes::expression(bool marked) {
  const auto letter = [](const char* text) { return Tree::of(*atom_of(text, {})); };
  const auto any = [&] { return Tree::repeat(letter("."), 0, -1); };
  if (chance(4)) return any();
  std::vector<Tree> parts{letter("C")};
  if (chance(40)) parts.push_back(any());
  if (marked) {
    if (chance(60)) parts.push_back(events(1));
    Atom vertex = rough();
    vertex.marked = true;
    parts.push_back(Tree::of(vertex));
  }
  parts.push_back(events(2));
  if (chance(30)) parts.push_back(events(1));
  if (chance(25))
    parts.push_back(any());
  else
    parts.push_back(Tree::of(light()));
  Tree tree = Tree::sequence(std::move(parts));
  if (!marked && chance(12)) return Tree::choice({tree, expression(false)});
  return tree;
}

OracleRoutes RandomRoutes::set() {
  static constexpr const char* kEstimators[] = {
      "path",          "path", "photons",      "photons",     "sppm",    "lighttrace", "lighttrace",
      "photons+light", "bdpt", "vcm",          "bpm",         "mlt",     "pssmlt",     "photonmap",
      "photonmap",     "ppm",  "path+photons", "pointlights", "forecast"};
  const Alphabet alphabet(static_cast<int>(labels_.size()));
  const auto possible = [&](bool marked) {
    for (;;) {
      Tree tree = expression(marked);
      if (Machine(tree, alphabet, Atom::Marks::kIgnore).matches_any_path()) return tree;
    }
  };
  std::vector<OracleRoute> routes, aovs;
  for (int n = 2 + below(4), i = 1; i <= n; ++i) {
    const EstimatorTraits* const kind =
        estimator_named(kEstimators[below(static_cast<int>(std::size(kEstimators)))]);
    Tree tree = possible(kind->merges && chance(45));
    // Half of the unmarked routes have a merge vertex in each path.
    if (kind->merges && !tree.has_marks() && chance(50))
      tree = Tree::sequence({Tree::of(*atom_of("C", {})),
                             Tree::repeat(Tree::of(set_of("SV", false)), 0, -1),
                             Tree::of(set_of("DG", false)), events(1), Tree::of(light())});
    if (!Machine(tree, alphabet, Atom::Marks::kIgnore).matches_any_path()) tree = possible(false);
    routes.push_back({"r" + std::to_string(i), std::move(tree), kind});
  }
  if (chance(85))
    routes.push_back(
        {"rest", Tree::repeat(Tree::of(*atom_of(".", {})), 0, -1), estimator_named("path")});
  for (int n = below(3), i = 1; i <= n; ++i)
    aovs.push_back({"a" + std::to_string(i), possible(false), estimator_named("path")});
  return OracleRoutes(std::move(routes), std::move(aovs), labels_);
}

}  // namespace nephroid::oracle
