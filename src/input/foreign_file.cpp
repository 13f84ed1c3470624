// A table of first bytes, a table of names, and checks of text formats.
#include "input/foreign_file.h"

#include <algorithm>
#include <cctype>

#include "input/file_bytes.h"

namespace nephroid {
namespace {

constexpr const char* kScene = "";
constexpr const char* kOtherName = " (scenes of this format have names that end in .gltf or .glb)";
constexpr const char* kMitsuba = " (scenes of this format have names that end in .xml)";
constexpr const char* kObj =
    " (OBJ files are scenes if their names end in .obj; in scenes, meshes are PLY files)";
constexpr const char* kMesh = " (meshes are read as PLY, by Shape \"plymesh\")";
constexpr const char* kPly = " (Shape \"plymesh\" \"string filename\" reads it)";
constexpr const char* kPicture =
    " (nephroid info describes pictures of renders; a scene's textures and lights read images)";
constexpr const char* kImage = " (a scene's textures and lights read images)";

struct Format {
  std::string_view mark;  ///< first bytes, or the end of a name
  const char* what;
  const char* hint;
};

constexpr Format kFirstBytes[] = {
    {"glTF", "a binary glTF scene (GLB)", kOtherName},
    {"#usda", "a USD scene", kScene},
    {"PXR-USDC", "a binary USD scene", kScene},
    {"BLENDER", "a Blender file", kScene},
    {"Kaydara FBX", "an FBX scene", kScene},
    {"; FBX", "an FBX scene", kScene},
    {"Ogawa", "an Alembic scene", kScene},
    {"ply\n", "a PLY mesh", kPly},
    {"ply\r", "a PLY mesh", kPly},
    {"\x76\x2f\x31\x01", "an OpenEXR picture", kPicture},
    {"\x89PNG", "a PNG picture", kImage},
    {"\xff\xd8\xff", "a JPEG picture", kImage},
    {"#?RADIANCE", "a Radiance HDR picture", kImage},
    {"NEPHSTA", "the state of a render", " (nephroid info describes it)"},
    {"PK\x03\x04", "a ZIP archive", kScene},
    {"\x1f\x8b", "a gzip file", " (packed scenes have names that end in .gz)"},
};

constexpr Format kSuffixes[] = {
    {".usd", "a USD scene", kScene},         {".usda", "a USD scene", kScene},
    {".usdc", "a binary USD scene", kScene}, {".usdz", "a USD scene", kScene},
    {".blend", "a Blender file", kScene},    {".fbx", "an FBX scene", kScene},
    {".abc", "an Alembic scene", kScene},    {".xml", "an XML scene", kScene},
    {".obj", "a Wavefront OBJ mesh", kObj},  {".mtl", "a Wavefront material library", kScene},
    {".stl", "an STL mesh", kMesh},          {".ply", "a PLY mesh", kPly},
    {".exr", "no OpenEXR picture", kImage},
};

bool is_space_or_line_end(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// The text from its first word on, without a byte order mark and without "#" comments.
std::string_view from_first_word(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (!text.empty() && (is_space_or_line_end(text[0]) || text[0] == '#'))
    text.remove_prefix(text[0] == '#' ? std::min(text.find('\n'), text.size()) : 1);
  return text;
}

/// True if the first word is one of OBJ's, with which no scene begins.
bool is_obj(std::string_view text) {
  const auto is_end = [](char c) { return is_space_or_line_end(c); };
  const auto* const end = std::find_if(text.begin(), text.end(), is_end);
  const std::string_view word = text.substr(0, static_cast<size_t>(end - text.begin()));
  constexpr std::string_view kWords[] = {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl"};
  return end != text.end() &&
         std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

Format xml_format(std::string_view text) {
  constexpr size_t kHead = 4096;
  const std::string_view head = text.substr(0, kHead);
  const auto has = [&](const char* tag) { return head.find(tag) != std::string_view::npos; };
  if (has("<scene")) return {"", "a Mitsuba scene", kMitsuba};
  if (has("<COLLADA")) return {"", "a COLLADA scene", kScene};
  return {"", "an XML file", kScene};
}

Format format_of(std::string_view bytes, const std::string& path) {
  for (const Format& format : kFirstBytes)
    if (bytes.starts_with(format.mark)) return format;
  const std::string_view text = from_first_word(bytes);
  if (text.empty()) return {"", "", ""};
  if (text[0] == '{' && text.find("\"asset\"") != std::string_view::npos)
    return {"", "a glTF scene", kOtherName};
  if (text[0] == '{') return {"", "a JSON file", kScene};
  if (text[0] == '<') return xml_format(text);
  if (is_obj(text)) return {"", "a Wavefront OBJ mesh", kObj};
  // Directives begin with a capital letter: such a file may be a scene whatever its name.
  if (std::isupper(static_cast<unsigned char>(text[0]))) return {"", "", ""};
  for (const Format& format : kSuffixes)
    if (has_suffix(path, std::string(format.mark))) return format;
  return {"", "", ""};
}

}  // namespace

std::string foreign_file_error(std::string_view bytes, const std::string& path) {
  const Format format = format_of(bytes, path);
  if (*format.what == '\0') return {};
  return "this is " + std::string(format.what) + ", expected a pbrt-v4 scene" + format.hint;
}

}  // namespace nephroid
