// The name of an Option directive may have its type ("bool pixelstats") or not ("pixelstats").
#include "input/option_directive.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "input/parameter_reader.h"
#include "input/spelling.h"

namespace nephroid {
namespace {

constexpr FormatParameter kOptions[] = {
    {"bool", "disablepixeljitter", "false", "", "all samples go through the centres of pixels"},
    {"bool", "disabletexturefiltering", "false", "", "textures are never filtered over footprints",
     Support::kNotNeeded},
    {"bool", "disablewavelengthjitter", "false", "", "all paths have the same wavelengths"},
    {"float", "displacementedgescale", "1", "", "times \"edgelength\" of displaced meshes"},
    {"bool", "forcediffuse", "false", "", "all surfaces are Lambertian and keep their reflectance"},
    {"bool", "keepcamera", "false", "",
     "the first Camera and the first Film count, later ones are ignored: gives an included scene "
     "another camera; not in pbrt-v4"},
    {"string", "msereferenceimage", "none", "", "nephroid compare measures pictures",
     Support::kWarned},
    {"string", "msereferenceout", "none", "", "nephroid compare measures pictures",
     Support::kWarned},
    {"bool", "pixelstats", "false", "", "", Support::kWarned},
    {"string", "rendercoordsys", "cameraworld", "",
     "cameraworld, camera or world: about which point moving instances turn"},
    {"integer", "seed", "0", "", "where the Sampler line gives none"},
    {"bool", "wavefront", "false", "", "", Support::kWarned},
};

std::string normalized(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (c != '-' && c != '_')
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

/// Skips the values of an option of unknown type, alone or in brackets.
void skip_values(TokenStream& tokens, const SourceLocation& option) {
  const Token* token = &tokens.next();
  if (token->kind == Token::Kind::kOpen)
    while (token->kind != Token::Kind::kClose && token->kind != Token::Kind::kEnd)
      token = &tokens.next();
  if (token->kind == Token::Kind::kEnd)
    throw SceneError(option, "this option has no value, expected one");
}

}  // namespace

FormatParameters format_options() {
  return kOptions;
}

std::optional<Parameter> read_option(TokenStream& tokens, Diagnostics& diagnostics) {
  const Token& token = tokens.expect_string("an option");
  Parameter option;
  option.where = token.where();
  const size_t space = token.text.find(' ');
  const std::string type(space == std::string_view::npos ? std::string_view()
                                                         : token.text.substr(0, space));
  option.name = normalized(type.empty() ? token.text : token.text.substr(space + 1));

  const auto* const known =
      std::find_if(std::begin(kOptions), std::end(kOptions),
                   [&](const FormatParameter& candidate) { return option.name == candidate.name; });
  if (known == std::end(kOptions)) {
    std::vector<std::string> names;
    for (const FormatParameter& candidate : kOptions) names.emplace_back(candidate.name);
    diagnostics.warn_of_unknown_name(
        option.where, "unknown option \"" + option.name + "\"" + did_you_mean(option.name, names));
    skip_values(tokens, option.where);
    return std::nullopt;
  }
  if (!type.empty() && type != known->type) {
    throw SceneError(option.where, "option \"" + option.name + "\" has type \"" + type +
                                       "\", expected \"" + known->type + "\"");
  }
  option.type = known->type;
  read_parameter_values(tokens, option);
  if (option.numbers.size() + option.strings.size() + option.bools.size() != 1)
    throw SceneError(option.where, "option \"" + option.name + "\" has several values, expected 1");
  return option;
}

}  // namespace nephroid
