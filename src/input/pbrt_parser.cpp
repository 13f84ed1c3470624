// Combines the token stream, the directive parser and the scene builder.
#include "input/pbrt_parser.h"

#include <utility>

#include "input/description_builder.h"
#include "input/directives.h"
#include "input/token_stream.h"

namespace nephroid {
namespace {

void parse(TokenStream& tokens, SceneDescription& scene, Diagnostics& diagnostics) {
  DescriptionBuilder builder(scene, diagnostics);
  V3Upgrade v3;
  const SourceLocation end = read_directives(tokens, builder, v3, diagnostics);
  builder.finish(end);
  v3.report(diagnostics);
}

}  // namespace

SceneDescription parse_pbrt_file(const std::string& path, Diagnostics& diagnostics,
                                 std::shared_ptr<SceneFiles> files) {
  SceneDescription scene;
  scene.file = shown_name(path);
  scene.files = files ? std::move(files) : files_of_scene(path);
  TokenStream tokens(*scene.files);
  tokens.open_scene(path);
  parse(tokens, scene, diagnostics);
  return scene;
}

SceneDescription parse_pbrt_string(const std::string& text, const std::string& name,
                                   const std::string& directory, Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.file = name;
  scene.files = std::make_shared<SceneFiles>(directory);
  TokenStream tokens(*scene.files);
  tokens.open_text(text, name);
  parse(tokens, scene, diagnostics);
  return scene;
}

}  // namespace nephroid
