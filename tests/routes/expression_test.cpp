// The grammar of light path expressions, and the messages about syntax errors: column, caret and
// what was expected.
#include "route/expression.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/errors.h"
#include "estimators.h"
#include "routes/letters.h"

namespace nephroid {
namespace {

// The message about a text, "" if it is correct.
template <class Parse>
std::string complaint(Parse parse) {
  try {
    parse();
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

struct Mistake {
  std::string text;
  size_t column;  ///< column, from 1
  std::string part_of_message;
};

// Message, then the text, then a caret below the column.
void expect_complaint(const std::string& message, const Mistake& m, const std::string& where) {
  SCOPED_TRACE(m.text);
  const std::string begin = where + ": column " + std::to_string(m.column) + ": ";
  EXPECT_EQ(message.substr(0, begin.size()), begin) << message;
  EXPECT_NE(message.find(m.part_of_message), std::string::npos) << message;
  const std::string end = "\n  " + m.text + "\n  " + std::string(m.column - 1, ' ') + "^";
  ASSERT_GE(message.size(), end.size()) << message;
  EXPECT_EQ(message.substr(message.size() - end.size()), end) << message;
}

TEST(Expression, MistakesAreShownWithACaret) {
  const std::vector<Mistake> mistakes = {
      {"a=C.*[DG:photons", 9, "expected ']' after the letters of a set, found the end"},
      {"a=C.*(DL:path", 9, "expected ')' for the '(' at column 6, found the end"},
      {"a=CD)L:path", 5, "')' without a '('"},
      {"a=C()L:path", 5, "empty group"},
      {"a=C(D|)L:path", 7, "expected an alternative"},
      {"a=C|:path", 5, "expected an alternative"},
      {"a=:path", 3, "expected an expression such as C.*L"},
      {"a=*L:path", 3, "a letter, a set or a group to repeat"},
      {"a=CS+*L:path", 6, "found another"},
      {"a=CS{3,1}L:path", 5, "the minimum 3 is above the maximum 1, expected {min,max}"},
      {"a=CS{}L:path", 6, "expected a number of repetitions"},
      {"a=CS{2L:path", 7, "expected '}' for the '{' at column 5, found 'L'"},
      {"a=CS{65}L:path", 6, "at most 64"},
      {"a=CXL:path", 4, "expected a letter, a set or a group (letters are C, D,"},
      {"a=C[]L:path", 5, "empty set"},
      {"a=C[D^S]L:path", 6, "'^' stands inside the set, expected it first"},
      {"a=C[D.]L:path", 6, "any symbol"},
      {"a=C[^CDGSVHL]L:path", 4, "excludes every symbol"},
      {"a=C<DR>L:path", 5, "expected the side, R, T or '.', found 'D'"},
      {"a=C<R>L:path", 6, "expected the class"},
      {"a=C<RV>L:path", 6, "V has no side"},
      {"a=C<.[]>L:path", 7, "empty set"},
      {"a=C<RD'x>L:path", 7, "ends the label"},
      {"a=C<RD''>L:path", 7, "found nothing"},
      {"a=C<RDL:path", 7, "expected a label or '>' for the '<' at column 4"},
      {"a=C.*<L.key>:path", 9, "found 'k' (did the shell take the quotes?)"},
      {"a=C<TSglass>L:path", 7, "found 'g' (did the shell take the quotes?)"},
      {"a=C<C'x'>L:path", 5, "the eye has no sides"},
      {"a=C'x'L:path", 4, "angle brackets"},
      {"a=CD]L:path", 5, "expected an opening bracket before ']'"},
      {"a=C@DL:path", 3, "photons can only be merged at D and G; C@ has neither"},
      {"a=C.*S@L:photons", 6, "S@ has neither"},
      {"a=C.*<V'fog'>@L:photons", 6, "has neither"},
      {"a=CD@@L:photons", 6, "found two"},
      {"a=CD+@L:photons", 6, "after the quantifier, expected it before"},
      {"a=C(DS)@L:photons", 8, "not a group"},
      {"a=@DL:photons", 3, "directly after a letter"},
      {"a=D.*L:path", 3, "can match no path: a path begins with C"},
      {"a=C.*D:path", 3, "can match no path"},
      {"a=CLD?S:path", 3, "can match no path"},
      {"a=CDL", 6, "expected ':' and an estimator"},
      {"a=CDL:", 7, "expected an estimator behind ':'"},
      {"a=CDL:fotons", 7,
       "path, photons, sppm, lighttrace, photons+light, bdpt, vcm, bpm, path+photons, mlt, "
       "pssmlt, "},
      {"CDL:path", 9, "found no '='"},
      {"=CDL:path", 1, "found none"},
      {"a b=CDL:path", 2, "found ' '"},
      {"albedo=CDL:path", 1, "pictures have already"},
      {"R=CDL:path", 1, "pictures have already"},
  };
  for (const Mistake& m : mistakes)
    expect_complaint(complaint([&] { parse_route(m.text, estimator_traits()); }), m, "--route");
}

TEST(Expression, MistakesInLayers) {
  expect_complaint(complaint([] { parse_aov("a=C.*L:path"); }), {"a=C.*L:path", 7, "no estimator"},
                   "--aov");
  expect_complaint(complaint([] { parse_aov("a=C.*(L"); }), {"a=C.*(L", 8, "expected ')'"},
                   "--aov");
}

TEST(Expression, ColumnsCountCharactersNotBytes) {
  const std::string message =
      complaint([] { parse_route("a=C<..'gl\xc3\xa4s'>X:path", estimator_traits()); });
  EXPECT_NE(message.find("column 14: "), std::string::npos) << message;
  EXPECT_EQ(message.substr(message.rfind('\n')), "\n  " + std::string(13, ' ') + "^");
}

TEST(Expression, NamesAreTakenOnce) {
  const std::string routes = complaint([] { compiled({"a=CL:path", "a=.*:path"}); });
  EXPECT_NE(routes.find("the name 'a' is taken"), std::string::npos) << routes;
  const std::string layers = complaint([] { compiled({"a=.*:path"}, {"a=CL"}); });
  EXPECT_NE(layers.find("--aov: column 1: the name 'a' is taken"), std::string::npos) << layers;
}

TEST(Expression, FilesHaveLinesAndComments) {
  const auto routes =
      parse_route_file("# the routes\n\n  glass = C <..'#1'>+ L : path  # seen\r\nrest=.*:photons",
                       estimator_traits(), "my.routes");
  ASSERT_EQ(routes.size(), 2u);
  EXPECT_EQ(routes[0].name, "glass");
  EXPECT_EQ(routes[0].expression, "C <..'#1'>+ L");
  EXPECT_EQ(routes[1].estimator, estimator_named("photons"));
  EXPECT_EQ(routes[1].source.where, "my.routes:4");
  const std::string message =
      complaint([] { parse_route_file("# none\na=C(L:path\n", estimator_traits(), "my.routes"); });
  EXPECT_EQ(message.find("my.routes:2: column 6: "), 0u) << message;
  const std::string indented = complaint(
      [] { parse_route_file("\n  \ta = C(L : path  # seen\n", estimator_traits(), "my.routes"); });
  EXPECT_EQ(indented.find("my.routes:2: column 11: "), 0u) << indented;
  EXPECT_EQ(indented.substr(indented.find('\n')), "\n    \ta = C(L : path\n    \t       ^");
  EXPECT_NE(complaint([] { parse_route_file("# none\n", estimator_traits(), "my.routes"); }), "");
}

TEST(Expression, LabelsMayHoldWhatElseHasAMeaning) {
  const RouteDefinition route = parse_route("a=C<..'a:b [c] @'>*L:path", estimator_traits());
  const std::vector<RouteDefinition> routes{route};
  EXPECT_EQ(mentioned_labels(routes, {}), std::vector<std::string>{"a:b [c] @"});
}

// Words of up to four plain events over D, G, S, V and H that an expression matches, with an
// emissive shape as the light. `aov` takes any expression, since layers need no partition.
std::vector<std::string> matched(const std::string& expression) {
  const Routes routes = compiled({"rest=.*:path"}, {"x=" + expression}).routes;
  std::vector<std::string> result;
  for (const std::string& w : words(4, "DGSVH")) {
    const Part part = routes.owner(read_from_eye(routes, w), light_symbol(LightKind::kShape, 0));
    if (!routes.parts()[part].aovs.empty()) result.push_back(w);
  }
  return result;
}

TEST(Expression, Grammar) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(matched("CL"), Words{""});
  EXPECT_EQ(matched("C D? L"), (Words{"", "D"}));
  EXPECT_EQ(matched("C(D|SS)L"), (Words{"D", "SS"}));
  EXPECT_EQ(matched("CD{2}L"), Words{"DD"});
  EXPECT_EQ(matched("CD{1,2}L"), (Words{"D", "DD"}));
  EXPECT_EQ(matched("CD{3,}L"), (Words{"DDD", "DDDD"}));
  EXPECT_EQ(matched("C(DS){2}L"), Words{"DSDS"});
  EXPECT_EQ(matched("C(D?S?)*VL").size(), words(3, "DS").size());
  EXPECT_EQ(matched("C[DG]L"), (Words{"D", "G"}));
  EXPECT_EQ(matched("C[^S]L"), (Words{"D", "G", "V", "H"}));
  EXPECT_EQ(matched("C<.[^S]>L"), (Words{"D", "G"}));
  EXPECT_EQ(matched("C<..>L"), (Words{"D", "G", "S", "V", "H"}));
  EXPECT_EQ(matched("CRL"), (Words{"D", "G", "S"}));
  EXPECT_EQ(matched("C<R.>L"), (Words{"D", "G", "S"}));
  EXPECT_EQ(matched("C.{2}"), (Words{"D", "G", "S", "V", "H"}));
  EXPECT_EQ(matched("C.@L"), (Words{"D", "G"}));
  EXPECT_EQ(matched("C[D<RS>]L"), (Words{"D", "S"}));
  EXPECT_EQ(matched("CT*L"), Words{""});
  EXPECT_EQ(matched("C<TD>*L"), Words{""});
  EXPECT_EQ(matched("CB|C<..'wall'>+L|CDO"), Words{"D"});
  EXPECT_EQ(matched(".*").size(), words(4, "DGSVH").size());
}

TEST(Expression, SidesLabelsAndKindsOfLights) {
  const Routes routes = compiled({"a=C<T[DG]'wall'>[^<O.'lamp'>L]*<O.'lamp'>:path",
                                  "b=C<V'fog'>B:path", "c=C.*M:path", "rest=.*:path"})
                            .routes;
  const auto owner = [&](EventSymbol e, LightSymbol l) {
    return routes.parts()[routes.owner(routes.next(routes.start(), e), l)].route;
  };
  const Label wall = routes.label("wall"), lamp = routes.label("lamp"), fog = routes.label("fog");
  const LightSymbol the_lamp = light_symbol(LightKind::kShape, lamp);
  EXPECT_EQ(owner(event_symbol(EventKind::kDT, wall), the_lamp), 0);
  EXPECT_EQ(owner(event_symbol(EventKind::kGT, wall), the_lamp), 0);
  EXPECT_EQ(owner(event_symbol(EventKind::kDR, wall), the_lamp), 3);
  EXPECT_EQ(owner(event_symbol(EventKind::kST, wall), the_lamp), 3);
  EXPECT_EQ(owner(event_symbol(EventKind::kDT, 0), the_lamp), 3);
  EXPECT_EQ(owner(event_symbol(EventKind::kDT, wall), light_symbol(LightKind::kShape, 0)), 3);
  EXPECT_EQ(owner(event_symbol(EventKind::kV, fog), light_symbol(LightKind::kDistant, lamp)), 1);
  EXPECT_EQ(owner(event_symbol(EventKind::kV, fog), light_symbol(LightKind::kEnvironment, 0)), 1);
  EXPECT_EQ(owner(event_symbol(EventKind::kV, fog), light_symbol(LightKind::kPoint, 0)), 3);
  EXPECT_EQ(owner(event_symbol(EventKind::kV, fog), light_symbol(LightKind::kMedium, 0)), 2);
}

TEST(Expression, TooMuchIsRefusedAndNotWaitedFor) {
  for (const std::string text :
       {"a=C(((.{64}){64}){64})L:path", "a=C.*D.{40}L:path", "a=C.*(D.{12}L|S.{13}L|G.{14}L):path"})
    EXPECT_NE(complaint([&] { compiled({text}); }), "") << text;
  EXPECT_NE(complaint([] { parse_route("a=" + std::string(1000, '(') + "C", estimator_traits()); }),
            "");
}

}  // namespace
}  // namespace nephroid
