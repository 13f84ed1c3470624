#include "options/gltf_support.h"

#include <fmt/format.h>

#include "input/gltf/support.h"

namespace nephroid {
namespace {

constexpr const char* kGltfHead =
    R"(# glTF 2.0

Made from the tables of the importer by `tools/update_docs`; do not edit.

`nephroid render model.glb` reads glTF 2.0. Each part of the format is

- **loaded**: the picture shows it;
- **approximated**: the picture shows something near it, and a warning says so where it matters;
- **ignored**: the picture does not need it, or a warning says what is lost;
- **refused**: an error if the file requires it.

The picture is `model.exr` in the current directory, unless `-o` names another. A missing image is an error, which names all missing
images.

Warnings and errors name the file and a JSON pointer: `model.glb#/materials/3: ...`. An extension
that is not in the table is an error if the file requires it, else a warning.

)";

const char* word_for(gltf::FeatureSupport support) {
  switch (support) {
    case gltf::FeatureSupport::kLoaded:
      return "loaded";
    case gltf::FeatureSupport::kApproximated:
      return "approximated";
    case gltf::FeatureSupport::kIgnored:
      return "ignored";
    case gltf::FeatureSupport::kRefused:
      break;
  }
  return "refused";
}

std::string table(const char* heading, std::span<const gltf::Feature> features, const char* quote) {
  std::string text = fmt::format("## {}\n\n| name | | |\n| --- | --- | --- |\n", heading);
  for (const gltf::Feature& feature : features)
    text += fmt::format("| {}{}{} | {} | {} |\n", quote, feature.name, quote,
                        word_for(feature.support), feature.note);
  return text;
}

}  // namespace

std::string gltf_support_markdown() {
  return kGltfHead + table("The format", gltf::feature_table(), "") + "\n" +
         table("Extensions", gltf::extension_table(), "`");
}

}  // namespace nephroid
