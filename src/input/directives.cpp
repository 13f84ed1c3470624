// The table of directives and the parsing of their arguments. Order as in pbrt-v4: the camera,
// film, sampler and so on before WorldBegin, the scene after it; transforms, colour spaces and
// media in both parts.
#include "input/directives.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "input/option_directive.h"
#include "input/parameter_reader.h"
#include "input/pbrt_v3.h"
#include "input/spelling.h"
#include "input/transform_directives.h"

namespace nephroid {
namespace {

/// The context of a directive's function.
struct Reader {
  TokenStream& tokens;
  DescriptionBuilder& builder;
  V3Upgrade& v3;
  Diagnostics& diagnostics;

  std::string name(const char* what) { return std::string(tokens.expect_string(what).text); }
  std::vector<Parameter> parameters() {
    std::vector<Parameter> list = read_parameters(tokens, builder.color_space(), diagnostics);
    v3.upgrade_colours(list);
    return list;
  }
  /// "type" parameters ...; `of` is the name of the directive.
  DirectiveDescription typed(const char* of, const SourceLocation& where) {
    DirectiveDescription directive;
    directive.type = name("a type");
    directive.where = directive.parameters.where = where;
    directive.parameters.list = parameters();
    v3.upgrade(of, directive);
    return directive;
  }
  double number(const char* directive) {
    return number_from(tokens.next(), std::string("a number of ") + directive);
  }
  Vec3d vector(const char* directive) {
    Vec3d v;
    for (int i = 0; i < 3; ++i) v[i] = number(directive);
    return v;
  }
  Mat44d matrix(const char* directive) {
    const bool bracketed = tokens.peek().kind == Token::Kind::kOpen;
    if (bracketed) tokens.next();
    std::array<double, 16> numbers;
    for (double& value : numbers) value = number(directive);
    if (bracketed) {
      const Token& close = tokens.next();
      if (close.kind != Token::Kind::kClose)
        throw SceneError(close.where(), std::string("expected ']' after the 16 numbers of ") +
                                            directive + ", found " + describe(close));
    }
    return matrix_from_numbers(numbers);
  }
};

enum class Part { kBoth, kOptions, kWorld };

struct Directive : FormatDirective {
  Part part;
  void (*read)(Reader& reader, const SourceLocation& where);
};

void read_rotate(Reader& r, const SourceLocation& where) {
  const double degrees = r.number("Rotate");
  const std::optional<Mat44d> m = rotation_matrix(degrees, r.vector("Rotate"));
  if (!m) throw SceneError(where, "the axis of Rotate is the zero vector, expected a direction");
  r.builder.concat_transform(*m, "Rotate", where);
}

void read_look_at(Reader& r, const SourceLocation& where) {
  const Vec3d eye = r.vector("LookAt"), target = r.vector("LookAt"), up = r.vector("LookAt");
  if (eye == target)
    throw SceneError(where, "LookAt looks from a point to itself, expected two different points");
  const std::optional<Mat44d> m = look_at_matrix(eye, target, up);
  if (!m)
    throw SceneError(where,
                     "the up vector of LookAt is zero or parallel to the view direction, expected "
                     "another direction");
  r.builder.look_at(*m, up, where);
}

void read_active_transform(Reader& r, const SourceLocation&) {
  const Token& token = r.tokens.next();
  const std::string_view which = token.kind == Token::Kind::kWord ? token.text : std::string_view();
  if (which != "All" && which != "StartTime" && which != "EndTime")
    throw SceneError(token.where(), "expected All, StartTime or EndTime, found " + describe(token));
  r.builder.set_active_transforms(which != "EndTime", which != "StartTime");
}

void read_transform_times(Reader& r, const SourceLocation& where) {
  const double start = r.number("TransformTimes");
  r.builder.set_transform_times(start, r.number("TransformTimes"), where);
}

void read_transform_begin(Reader& r, const SourceLocation& where) {
  r.diagnostics.warn(where, "TransformBegin is deprecated, use AttributeBegin");
  r.builder.attribute_begin(where);
}

void read_attribute(Reader& r, const SourceLocation&) {
  const Token& token = r.tokens.expect_string("an attribute target");
  const std::string target(token.text);
  const SourceLocation target_where = token.where();
  r.builder.set_defaults(target, r.parameters(), target_where);
}

void read_color_space(Reader& r, const SourceLocation&) {
  const Token& token = r.tokens.expect_string("a color space");
  r.builder.set_color_space(std::string(token.text), token.where());
}

void read_medium_interface(Reader& r, const SourceLocation&) {
  const std::string inside = r.name("a medium");
  const bool two = r.tokens.peek().kind == Token::Kind::kString;
  r.builder.set_medium_interface(inside, two ? r.name("a medium") : inside);
}

void read_texture(Reader& r, const SourceLocation& where) {
  const std::string name = r.name("a texture name");
  const Token& type_token = r.tokens.expect_string("a texture type");
  const std::string value_type =
      r.v3.texture_values(std::string(type_token.text), type_token.where());
  if (value_type != "float" && value_type != "spectrum") {
    throw SceneError(type_token.where(), "unknown texture type " + describe(type_token) +
                                             ", expected \"float\" or \"spectrum\"");
  }
  DirectiveDescription texture = r.typed("Texture", where);
  r.v3.upgrade_texture(value_type, texture);
  r.builder.add_texture(name, value_type, std::move(texture));
}

/// Directives with a name instead of a type: MakeNamedMaterial "name" parameters ...
void read_named(Reader& r, const char* of, const SourceLocation& where,
                void (DescriptionBuilder::*add)(const std::string&, DirectiveDescription)) {
  DirectiveDescription directive;
  const std::string name = r.name("a name");
  directive.where = directive.parameters.where = where;
  directive.parameters.list = r.parameters();
  r.v3.upgrade(of, directive);
  if (name.empty()) throw SceneError(where, "the name is empty, expected at least one character");
  (r.builder.*add)(name, std::move(directive));
}

void read_include(Reader& r, const SourceLocation&) {
  r.tokens.include(r.tokens.expect_string("a file name"));
}

void read_import(Reader& r, const SourceLocation& where) {
  r.tokens.enter(r.tokens.expect_string("a file name"));
  r.builder.import_begin(where);
  read_directives(r.tokens, r.builder, r.v3, r.diagnostics);
  r.builder.import_end();
  r.tokens.leave();
}

/// pbrt-v3's end of a scene, after which pbrt-v3 allows another frame.
void read_world_end(Reader& r, const SourceLocation& where) {
  if (!r.builder.in_world()) throw SceneError(where, "WorldEnd without WorldBegin");
  r.v3.note(where, "WorldEnd is not needed");
  const Token& token = r.tokens.peek();
  if (token.kind != Token::Kind::kEnd)
    throw SceneError(token.where(),
                     "expected the end of the scene after WorldEnd, found " + describe(token));
}

using Place = SourceLocation;

// Sorted by topic. A linear search is cheap compared with parsing a directive's numbers.
constexpr std::array kDirectives = {
    Directive{{"Include", "\"file\"", "reads the file in place"}, Part::kBoth, read_include},
    Directive{
        {"Import", "\"file\"", "reads the file as a scope of its own"}, Part::kWorld, read_import},

    Directive{{"Identity", "", ""},
              Part::kBoth,
              [](Reader& r, const Place& p) { r.builder.set_transform(Mat44d(), p); }},
    Directive{{"Translate", "x y z", ""},
              Part::kBoth,
              [](Reader& r, const Place& p) {
                r.builder.concat_transform(translation_matrix(r.vector("Translate")), "Translate",
                                           p);
              }},
    Directive{{"Scale", "x y z", ""},
              Part::kBoth,
              [](Reader& r, const Place& p) {
                r.builder.concat_transform(scale_matrix(r.vector("Scale")), "Scale", p);
              }},
    Directive{{"Rotate", "degrees x y z", ""}, Part::kBoth, read_rotate},
    Directive{{"LookAt", "eye target up, 9 numbers", ""}, Part::kBoth, read_look_at},
    Directive{{"Transform", "[ 16 numbers ]", ""},
              Part::kBoth,
              [](Reader& r, const Place& p) { r.builder.set_transform(r.matrix("Transform"), p); }},
    Directive{{"ConcatTransform", "[ 16 numbers ]", ""},
              Part::kBoth,
              [](Reader& r, const Place& p) {
                r.builder.concat_transform(r.matrix("ConcatTransform"), "ConcatTransform", p);
              }},
    Directive{{"CoordinateSystem", "\"name\"", ""},
              Part::kBoth,
              [](Reader& r, const Place&) {
                r.builder.name_coordinate_system(r.name("a coordinate system"));
              }},
    Directive{{"CoordSysTransform", "\"name\"", ""},
              Part::kBoth,
              [](Reader& r, const Place& p) {
                r.builder.use_coordinate_system(r.name("a coordinate system"), p);
              }},
    Directive{{"ActiveTransform", "StartTime, EndTime or All",
               "motion of cameras, shapes and instances; see the differences for what cannot move"},
              Part::kBoth,
              read_active_transform},
    Directive{{"TransformTimes", "start end", "in s, 0 and 1 by default"},
              Part::kOptions,
              read_transform_times},

    Directive{{"Option", "\"type name\" value", "see options"},
              Part::kBoth,
              [](Reader& r, const Place&) {
                if (auto option = read_option(r.tokens, r.diagnostics))
                  r.builder.add_option(std::move(*option));
              }},
    Directive{{"ColorSpace", "\"name\"", "srgb (the default), dci-p3, rec2020 or aces2065-1"},
              Part::kBoth,
              read_color_space},
    Directive{{"Camera", "\"type\" parameters",
               "see cameras; a perspective camera at the origin with a warning if there is none"},
              Part::kOptions,
              [](Reader& r, const Place& p) { r.builder.set_camera(r.typed("Camera", p)); }},
    Directive{{"Film", "\"type\" parameters", "see films"},
              Part::kOptions,
              [](Reader& r, const Place& p) { r.builder.set_film(r.typed("Film", p)); }},
    Directive{{"Sampler", "\"type\" parameters", "see samplers"},
              Part::kOptions,
              [](Reader& r, const Place& p) { r.builder.set_sampler(r.typed("Sampler", p)); }},
    Directive{
        {"PixelFilter", "\"type\" parameters", "see pixel filters"},
        Part::kOptions,
        [](Reader& r, const Place& p) { r.builder.set_pixel_filter(r.typed("PixelFilter", p)); }},
    Directive{
        {"Integrator", "\"type\" parameters", "see integrators"},
        Part::kOptions,
        [](Reader& r, const Place& p) { r.builder.set_integrator(r.typed("Integrator", p)); }},
    Directive{
        {"Accelerator", "\"type\" parameters", "see accelerators"},
        Part::kOptions,
        [](Reader& r, const Place& p) { r.builder.set_accelerator(r.typed("Accelerator", p)); }},
    Directive{{"WorldBegin", "", ""},
              Part::kOptions,
              [](Reader& r, const Place&) { r.builder.world_begin(); }},

    Directive{{"AttributeBegin", "", ""},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.attribute_begin(p); }},
    Directive{{"AttributeEnd", "", ""},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.attribute_end(p); }},
    Directive{{"TransformBegin", "", "deprecated: AttributeBegin with a warning"},
              Part::kWorld,
              read_transform_begin},
    Directive{{"TransformEnd", "", "deprecated: AttributeEnd"},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.attribute_end(p); }},
    Directive{{"Attribute", "\"target\" parameters",
               "defaults for shape, light, material, medium or texture"},
              Part::kBoth,
              read_attribute},
    Directive{{"ReverseOrientation", "", ""},
              Part::kWorld,
              [](Reader& r, const Place&) { r.builder.reverse_orientation(); }},
    Directive{{"MediumInterface", "\"inside\" \"outside\"",
               "of shapes, of the camera and of lights; with one name both"},
              Part::kBoth,
              read_medium_interface},
    Directive{{"ObjectBegin", "\"name\"", "shapes in it do not emit (a warning)"},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.object_begin(r.name("an object"), p); }},
    Directive{{"ObjectEnd", "", ""},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.object_end(p); }},
    Directive{{"ObjectInstance", "\"name\"", ""},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.object_instance(r.name("an object"), p); }},

    Directive{{"Material", "\"type\" parameters", "see materials; diffuse if there is none"},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.add_material(r.typed("Material", p)); }},
    Directive{
        {"NamedMaterial", "\"name\"", "may stand before its MakeNamedMaterial"},
        Part::kWorld,
        [](Reader& r, const Place& p) { r.builder.use_named_material(r.name("a material"), p); }},
    Directive{{"MakeNamedMaterial", "\"name\" \"string type\" parameters", "see materials"},
              Part::kWorld,
              [](Reader& r, const Place& p) {
                read_named(r, "Material", p, &DescriptionBuilder::add_named_material);
              }},
    Directive{{"MakeNamedMedium", "\"name\" \"string type\" parameters", "see media"},
              Part::kBoth,
              [](Reader& r, const Place& p) {
                read_named(r, "MakeNamedMedium", p, &DescriptionBuilder::add_medium);
              }},
    Directive{{"Texture", "\"name\" \"float or spectrum\" \"class\" parameters", "see textures"},
              Part::kWorld,
              read_texture},
    Directive{{"LightSource", "\"type\" parameters", "see lights"},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.add_light(r.typed("LightSource", p)); }},
    Directive{
        {"AreaLightSource", "\"type\" parameters", "see area lights; of the shapes that follow"},
        Part::kWorld,
        [](Reader& r, const Place& p) { r.builder.set_area_light(r.typed("AreaLightSource", p)); }},
    Directive{{"Shape", "\"type\" parameters", "see shapes"},
              Part::kWorld,
              [](Reader& r, const Place& p) { r.builder.add_shape(r.typed("Shape", p)); }},
};

[[noreturn]] void unknown_directive(const Token& token) {
  if (token.kind != Token::Kind::kWord)
    throw SceneError(token.where(), "expected a directive, found " + describe(token));
  std::vector<std::string> names;
  for (const Directive& directive : kDirectives) names.emplace_back(directive.name);
  throw SceneError(token.where(),
                   "unknown directive " + describe(token) + did_you_mean(token.text, names));
}

void check_part(const Directive& directive, bool in_world, const SourceLocation& where) {
  if (directive.part == Part::kOptions && in_world) {
    throw SceneError(
        where, std::string(directive.name) + " after WorldBegin, expected it before WorldBegin");
  }
  if (directive.part == Part::kWorld && !in_world) {
    throw SceneError(
        where, std::string(directive.name) + " before WorldBegin, expected it after WorldBegin");
  }
}

}  // namespace

std::vector<FormatDirective> format_directives() {
  return std::vector<FormatDirective>(kDirectives.begin(), kDirectives.end());
}

SourceLocation read_directives(TokenStream& tokens, DescriptionBuilder& builder, V3Upgrade& v3,
                               Diagnostics& diagnostics) {
  Reader reader{tokens, builder, v3, diagnostics};
  for (;;) {
    const Token& token = tokens.next();
    const SourceLocation where = token.where();
    if (token.kind == Token::Kind::kEnd) return where;
    if (token.kind == Token::Kind::kWord && token.text == "WorldEnd") {
      read_world_end(reader, where);
      continue;
    }
    if (token.kind != Token::Kind::kWord) unknown_directive(token);
    const std::string_view name = v3.directive_name(token.text, where);
    const Directive* const directive =
        std::find_if(kDirectives.begin(), kDirectives.end(),
                     [&](const Directive& known) { return name == known.name; });
    if (directive == kDirectives.end()) unknown_directive(token);
    check_part(*directive, builder.in_world(), where);
    directive->read(reader, where);
  }
}

}  // namespace nephroid
