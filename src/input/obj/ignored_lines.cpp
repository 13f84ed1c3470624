#include "input/obj/ignored_lines.h"

#include <algorithm>
#include <utility>

#include "input/spelling.h"

namespace nephroid {
namespace {

constexpr FormatParameter row(const char* keyword, const char* arguments, const char* note,
                              Support support = Support::kRendered) {
  return {arguments, keyword, "", "", note, support};
}
constexpr FormatParameter ignored(const char* keyword, const char* arguments, const char* reason) {
  return row(keyword, arguments, reason, Support::kWarned);
}

constexpr const char* kNoArea = "it has no area";
constexpr const char* kFreeForm = "free-form curves and surfaces are not read, export polygons";
constexpr const char* kDisplay = "it is a hint for the display of other programs";

constexpr FormatParameter kKeywords[] = {
    row("v", "x y z", "a vertex"),
    ignored("v with a colour", "x y z r g b", "vertex colours have no effect on a material"),
    ignored("v with a weight", "x y z w", "weights are for free-form curves and surfaces"),
    row("vt", "u [v]", "a texture coordinate, (0, 0) at the lower left of the image"),
    row("vn", "x y z", "a normal; faces without normals are flat"),
    ignored("vn with nan or inf", "x y z", "faces have their own normal there"),
    row("f", "v/vt/vn ...",
        "a face of at most 16384 corners, left out with a warning if it has one or two; negative "
        "indices count back"),
    row("fo", "v/vt/vn ...", "an old name of f"),
    row("o", "name", "faces of each object are a shape"),
    row("g", "name ...", "faces of each group are a shape"),
    row("usemtl", "name", "the material of the faces that follow"),
    row("mtllib", "file ...", "files of materials"),
    ignored("s", "group|off",
            "smoothing groups make no normals, so these faces are flat; export with normals"),
    ignored("p", "v ...", kNoArea),
    ignored("l", "v/vt ...", kNoArea),
    ignored("vp", "u [v [w]]", kFreeForm),
    ignored("cstype", "...", kFreeForm),
    ignored("deg", "...", kFreeForm),
    ignored("bmat", "...", kFreeForm),
    ignored("step", "...", kFreeForm),
    ignored("curv", "...", kFreeForm),
    ignored("curv2", "...", kFreeForm),
    ignored("surf", "...", kFreeForm),
    ignored("parm", "...", kFreeForm),
    ignored("trim", "...", kFreeForm),
    ignored("hole", "...", kFreeForm),
    ignored("scrv", "...", kFreeForm),
    ignored("sp", "...", kFreeForm),
    ignored("end", "", kFreeForm),
    ignored("con", "...", kFreeForm),
    ignored("mg", "...", kFreeForm),
    ignored("bevel", "on|off", kDisplay),
    ignored("c_interp", "on|off", kDisplay),
    ignored("d_interp", "on|off", kDisplay),
    ignored("lod", "level", kDisplay),
    ignored("shadow_obj", "file", "objects that only cast shadows are not rendered"),
    ignored("trace_obj", "file", "objects that are only reflected are not rendered"),
    ignored("maplib", "file ...", "textures of faces come from materials only"),
    ignored("usemap", "name", "textures of faces come from materials only"),
    ignored("call", "file ...", "other files are not read into this one"),
    ignored("csh", "command", "commands are not run"),
};

}  // namespace

FormatParameters obj_keywords() {
  return kKeywords;
}

IgnoredLines::IgnoredLines(std::shared_ptr<const std::string> file, FormatParameters rows,
                           Diagnostics& diagnostics)
    : file_(std::move(file)), rows_(rows), diagnostics_(diagnostics) {}

void IgnoredLines::add(const std::string& keyword, int line) {
  Lines& lines = lines_[keyword];
  if (lines.count++ == 0) lines.first = line;
}

void IgnoredLines::report() const {
  std::vector<std::string> names;
  for (const FormatParameter& row : rows_) names.emplace_back(row.name);
  for (const auto& entry : lines_) {
    const std::string& keyword = entry.first;
    const Lines& lines = entry.second;
    const SourceLocation where{file_, lines.first, 0};
    const std::string subject = lines.count == 1
                                    ? "\"" + keyword + "\" is ignored"
                                    : std::to_string(lines.count) + " lines \"" + keyword +
                                          "\" are ignored, this is the first";
    const auto known = std::find_if(rows_.begin(), rows_.end(), [&](const FormatParameter& row) {
      return keyword == row.name;
    });
    if (known != rows_.end() && known->support == Support::kNotNeeded) continue;
    if (known != rows_.end())
      diagnostics_.warn(where, subject + ": " + known->note);
    else
      diagnostics_.warn_of_unknown_name(
          where, subject + ": the format has no such keyword" + did_you_mean(keyword, names));
  }
}

}  // namespace nephroid
