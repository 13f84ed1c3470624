// Reads OBJ files line by line. Faces go to the part of the current object, group and material.
#include "input/obj/obj_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <span>
#include <tuple>

#include "core/counted.h"
#include "input/file_bytes.h"
#include "input/number_text.h"
#include "input/obj/ignored_lines.h"
#include "input/obj/obj_corners.h"
#include "input/obj/text_lines.h"
#include "input/polygon_triangles.h"

namespace nephroid {
namespace {

/// A part with the indices of its vertices.
struct PartInWork {
  ObjPart part;
  CornerIndex vertices;
};

class ObjReader {
 public:
  ObjReader(std::string path, Diagnostics& diagnostics)
      : path_(std::make_shared<const std::string>(std::move(path))),
        ignored_(path_, obj_keywords(), diagnostics) {}

  ObjFile read(std::string_view bytes);

 private:
  using PartKey = std::tuple<std::string, std::string, std::string, bool, bool>;

  SourceLocation here() const { return {path_, line_, 0}; }
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(here(), message); }

  void read_line(std::string_view text);
  /// Reads `least` to `Most` numbers. Returns their count.
  template <size_t Most>
  size_t read_numbers(std::string_view text, size_t least, std::array<float, Most>* numbers) const;
  void read_position(std::string_view text);
  void read_normal(std::string_view text);
  void read_uv(std::string_view text);
  void read_libraries(std::string_view text);
  void read_smoothing(std::string_view text);
  void read_face(std::string_view text);
  Corner read_corner(std::string_view word) const;
  /// The index, counted from 0, of what "3" or "-1" names among `count`.
  uint32_t resolve_index(std::string_view word, size_t count, const char* what) const;
  PartInWork& part_for(bool has_uvs, bool has_normals);
  uint32_t vertex_of(PartInWork& part, const Corner& corner) const;
  void add_triangles(PartInWork& part);

  std::shared_ptr<const std::string> path_;
  IgnoredLines ignored_;
  int line_ = 0;
  std::vector<Vec3f> positions_, normals_;
  std::vector<Vec2f> uvs_;
  std::string object_, group_, material_;
  bool is_smooth_ = false;
  std::vector<Corner> corners_;  ///< corners of the current face
  std::vector<Vec3f> ring_;      ///< positions of these corners
  std::vector<PartInWork> parts_;
  std::map<PartKey, size_t> part_of_;
  size_t current_ = kNoPart;  ///< part of the last face
  std::vector<ObjLibrary> libraries_;

  static constexpr size_t kNoPart = std::numeric_limits<size_t>::max();
};

ObjFile ObjReader::read(std::string_view bytes) {
  TextLines lines(bytes);
  for (TextLine line; lines.next(&line);) {
    line_ = line.number;
    read_line(line.text);
  }
  ignored_.report();
  ObjFile file;
  file.libraries = std::move(libraries_);
  for (PartInWork& work : parts_) file.parts.push_back(std::move(work.part));
  return file;
}

void ObjReader::read_line(std::string_view text) {
  const std::string_view keyword = take_word(&text);
  const std::string rest(keyword == "f" || keyword[0] == 'v' ? "" : stripped(text));
  if (keyword == "v") return read_position(text);
  if (keyword == "vn") return read_normal(text);
  if (keyword == "vt") return read_uv(text);
  if (keyword == "f" || keyword == "fo") return read_face(text);
  if (keyword == "mtllib") return read_libraries(text);
  if (keyword == "s") return read_smoothing(rest);
  if (keyword != "o" && keyword != "g" && keyword != "usemtl")
    return ignored_.add(std::string(keyword), line_);
  current_ = kNoPart;
  (keyword == "o" ? object_ : keyword == "g" ? group_ : material_) = rest;
}

template <size_t Most>
size_t ObjReader::read_numbers(std::string_view text, size_t least,
                               std::array<float, Most>* numbers) const {
  size_t count = 0;
  for (std::string_view word = take_word(&text); !word.empty(); word = take_word(&text)) {
    const std::optional<double> value = parse_number(word);
    if (!value)
      fail("\"" + std::string(word) + "\" is not a number, expected one as in 1.5 or 2e-3");
    if (count == Most)
      fail("the line has too many numbers, expected at most " + std::to_string(Most));
    (*numbers)[count++] = static_cast<float>(*value);
  }
  if (count < least)
    fail("the line has " + counted(count, "number") + ", expected at least " +
         std::to_string(least));
  return count;
}

void ObjReader::read_position(std::string_view text) {
  std::array<float, 8> v{};
  const size_t count = read_numbers(text, 3, &v);
  if (count >= 6) ignored_.add("v with a colour", line_);
  if (count == 4 && v[3] != 1) ignored_.add("v with a weight", line_);
  positions_.emplace_back(v[0], v[1], v[2]);
}

void ObjReader::read_normal(std::string_view text) {
  std::array<float, 3> n{};
  read_numbers(text, 3, &n);
  const Vec3f normal(n[0], n[1], n[2]);
  if (!is_finite(normal)) ignored_.add("vn with nan or inf", line_);
  normals_.push_back(is_finite(normal) ? normal : Vec3f(0, 0, 0));
}

void ObjReader::read_uv(std::string_view text) {
  std::array<float, 3> uv{};
  read_numbers(text, 1, &uv);
  uvs_.emplace_back(uv[0], uv[1]);
}

/// A name ends at ".mtl" before a blank, since names may hold blanks.
void ObjReader::read_libraries(std::string_view text) {
  std::string name;
  for (std::string_view word = take_word(&text); !word.empty(); word = take_word(&text)) {
    name += (name.empty() ? "" : " ") + std::string(word);
    if (!has_suffix(name, ".mtl")) continue;
    libraries_.push_back({name, here()});
    name.clear();
  }
  if (!name.empty()) libraries_.push_back({name, here()});
}

void ObjReader::read_smoothing(std::string_view text) {
  is_smooth_ = !text.empty() && text != "off" && text != "0";
}

uint32_t ObjReader::resolve_index(std::string_view word, size_t count, const char* what) const {
  const std::optional<long long> index = parse_integer(word);
  if (!index)
    fail("\"" + std::string(word) + "\" is not an index, expected an integer as in 1/2/3");
  const auto end = static_cast<long long>(count);
  if (*index == 0 || *index > end || *index < -end)
    fail(std::string(what) + " index " + std::to_string(*index) + " is out of range, there are " +
         std::to_string(count) + " so far, counted from 1 (or back from -1)");
  return static_cast<uint32_t>(*index > 0 ? *index - 1 : end + *index);
}

/// v, v/vt, v//vn or v/vt/vn.
Corner ObjReader::read_corner(std::string_view word) const {
  std::string_view fields[3];
  size_t field = 0;
  for (size_t begin = 0; begin <= word.size(); ++field) {
    const size_t slash = std::min(word.find('/', begin), word.size());
    if (field == 3)
      fail("\"" + std::string(word) +
           "\" has more than three indices, expected at most three as in 1/2/3");
    fields[field] = word.substr(begin, slash - begin);
    begin = slash + 1;
  }
  Corner corner;
  corner.position = resolve_index(fields[0], positions_.size(), "vertex");
  if (!fields[1].empty()) corner.uv = resolve_index(fields[1], uvs_.size(), "texture");
  if (!fields[2].empty()) corner.normal = resolve_index(fields[2], normals_.size(), "normal");
  return corner;
}

PartInWork& ObjReader::part_for(bool has_uvs, bool has_normals) {
  if (current_ != kNoPart && parts_[current_].vertices.has_uvs() == has_uvs &&
      parts_[current_].vertices.has_normals() == has_normals)
    return parts_[current_];
  const auto [entry, is_new] =
      part_of_.try_emplace({object_, group_, material_, has_uvs, has_normals}, parts_.size());
  current_ = entry->second;
  if (is_new)
    parts_.push_back({{object_, group_, material_, here(), {}}, CornerIndex(has_uvs, has_normals)});
  return parts_[current_];
}

uint32_t ObjReader::vertex_of(PartInWork& work, const Corner& corner) const {
  MeshData& mesh = work.part.mesh;
  const auto [vertex, is_new] = work.vertices.find_or_add(corner);
  if (!is_new) return vertex;
  mesh.positions.push_back(positions_[corner.position]);
  if (work.vertices.has_uvs()) {
    const Vec2f uv = uvs_[corner.uv];
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
      fail("texture coordinate " + std::to_string(corner.uv + 1) +
           " is not finite, expected finite numbers");
    mesh.uvs.push_back(uv);
  }
  if (work.vertices.has_normals()) mesh.normals.push_back(normals_[corner.normal]);
  return vertex;
}

void ObjReader::add_triangles(PartInWork& work) {
  const auto add = [&](size_t a, size_t b, size_t c) {
    for (const size_t corner : {a, b, c})
      work.part.mesh.triangles.push_back(vertex_of(work, corners_[corner]));
  };
  if (corners_.size() == 3) return add(0, 1, 2);
  const std::vector<uint32_t> cut = triangulate_polygon(ring_);
  for (size_t i = 0; i < cut.size(); i += 3) add(cut[i], cut[i + 1], cut[i + 2]);
}

void ObjReader::read_face(std::string_view text) {
  corners_.clear();
  ring_.clear();
  bool has_uvs = true, has_normals = true;
  for (std::string_view word = take_word(&text); !word.empty(); word = take_word(&text)) {
    const Corner corner = read_corner(word);
    const Vec3f& position = positions_[corner.position];
    if (!is_finite(position))
      fail("vertex " + std::to_string(corner.position + 1) +
           " is not finite, expected finite numbers");
    if (corners_.size() == kMaxPolygonCorners)
      fail("the face has too many corners, expected at most " + std::to_string(kMaxPolygonCorners));
    has_uvs = has_uvs && corner.uv != Corner::kNone;
    has_normals = has_normals && corner.normal != Corner::kNone;
    corners_.push_back(corner);
    ring_.push_back(position);
  }
  if (corners_.empty()) fail("the face has no corners, expected at least 3");
  // A triangle without area: the check of the mesh removes and counts it.
  while (corners_.size() < 3) corners_.push_back(corners_.back());
  if (is_smooth_ && !has_normals) ignored_.add("s", line_);
  add_triangles(part_for(has_uvs, has_normals));
}

}  // namespace

ObjFile read_obj(SceneFiles& files, const std::string& path, const SourceLocation& wanted_by,
                 Diagnostics& diagnostics) {
  try {
    std::string bytes;
    try {
      bytes = files.read(path);
    } catch (const IoError& error) {
      file_is_unreadable(wanted_by, error.what());
    }
    return ObjReader(path, diagnostics).read(bytes);
  } catch (const std::bad_alloc&) {
    throw SceneError(wanted_by, "cannot use \"" + path + "\": it does not fit into memory");
  }
}

MeshData joined_mesh(const ObjFile& file) {
  bool has_uvs = false, has_normals = false;
  for (const ObjPart& part : file.parts) {
    has_uvs = has_uvs || !part.mesh.uvs.empty();
    has_normals = has_normals || !part.mesh.normals.empty();
  }
  MeshData all;
  for (const ObjPart& part : file.parts) {
    const MeshData& mesh = part.mesh;
    const auto first = static_cast<uint32_t>(all.positions.size());
    for (const uint32_t vertex : mesh.triangles) all.triangles.push_back(first + vertex);
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
    all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    if (has_normals) all.normals.resize(all.positions.size(), Vec3f(0, 0, 0));
    if (has_uvs) all.uvs.resize(all.positions.size(), Vec2f(0, 0));
  }
  return all;
}

}  // namespace nephroid
