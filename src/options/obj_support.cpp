#include "options/obj_support.h"

#include <fmt/format.h>

#include "input/obj/ignored_lines.h"
#include "input/obj/mtl_keywords.h"
#include "options/table_cell.h"

namespace nephroid {
namespace {

constexpr const char* kObjHead = R"(# OBJ and MTL files

Made from the tables of the importer by `tools/update_docs`; do not edit.

A file whose name ends in `.obj` or `.obj.gz` is read as a scene. `nephroid convert model.obj model.pbrt` writes the imported scene
in the format of pbrt-v4. Each keyword is

- **loaded**;
- **not needed**: the picture does not depend on it;
- **warned**: ignored with a warning at its first line, which gives the reason.

Unknown keywords give a warning, and with `--strict` an error. A wrong number or index is an error with its file and line.

- An OBJ file has no camera and no light. The view is from the front right, the front is +z, and up is +y. A grey sky and a soft
  lamp light it. `--floor`, `--sun`, `--environment` and `--exposure` change that ([options](options.md#render)).
- The picture of `model.obj` is `model.exr` in the current directory, unless `-o` names another.
- Materials that emit are the light of a file that has them, and lamps have their names. The exposure is chosen for them unless `--exposure` gives one:
  `--exposure 0` shows a candela per square metre as 1.
- Files lie in the folder of the scene or below it; `--allow-outside` permits others. Images are looked for in the folder of the
  MTL file that names them.
- A missing MTL file is a warning, and so is a material that is not defined; the faces are grey. A missing image is an error, which
  names all missing images.
- A # behind a blank begins a comment, but not before the number of a material, as in
  `usemtl Material #2`.
- Faces without normals are flat. Texture coordinates have (0, 0) at the lower left of an image.
- Images of colours are sRGB if they store integers. Those of numbers (`map_d`, `map_Pr`, `map_Pm`, `bump`) are linear.
)";

const char* word_of(Support support) {
  switch (support) {
    case Support::kRendered:
      return "loaded";
    case Support::kNotNeeded:
      return "not needed";
    case Support::kWarned:
      return "warned";
    case Support::kRefused:
      break;
  }
  return "refused";
}

std::string table_of(const char* heading, FormatParameters rows) {
  std::string text = fmt::format(
      "\n## {}\n\n| keyword | values | default | |\n| --- | --- | --- | --- |\n", heading);
  for (const FormatParameter& row : rows)
    text +=
        fmt::format("| `{}` | {} | {} | {}{}{} |\n", row.name, table_cell(row.type), row.fallback,
                    word_of(row.support), *row.note ? ": " : "", table_cell(row.note));
  return text;
}

}  // namespace

std::string obj_support_markdown() {
  return kObjHead + table_of("Geometry", obj_keywords()) +
         table_of("Materials, as \"principled\"", mtl_keywords());
}

}  // namespace nephroid
