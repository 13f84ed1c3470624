#include "input/convert/ply_writer.h"

#include <bit>

namespace nephroid {
namespace {

class PlyText {
 public:
  explicit PlyText(std::string header) : bytes_(std::move(header)) {}
  void add(uint32_t bits) {
    for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xff);
  }
  void add(float value) { add(std::bit_cast<uint32_t>(value)); }
  void add_count(int corners) { bytes_ += static_cast<char>(corners); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

std::string header_of(const MeshData& mesh) {
  const auto floats = [](std::initializer_list<const char*> names) {
    std::string lines;
    for (const char* name : names) lines += std::string("property float ") + name + "\n";
    return lines;
  };
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(mesh.positions.size()) + "\n" + floats({"x", "y", "z"});
  if (!mesh.normals.empty()) header += floats({"nx", "ny", "nz"});
  if (!mesh.uvs.empty()) header += floats({"u", "v"});
  header += "element face " + std::to_string(mesh.triangles.size() / 3 + mesh.quads.size() / 4) +
            "\nproperty list uchar uint vertex_indices\n";
  if (!mesh.face_indices.empty()) header += "property int face_indices\n";
  return header + "end_header\n";
}

}  // namespace

std::string ply_bytes(const MeshData& mesh) {
  PlyText ply(header_of(mesh));
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int i = 0; i < 3; ++i) ply.add(mesh.positions[v][i]);
    for (int i = 0; i < 3 && !mesh.normals.empty(); ++i) ply.add(mesh.normals[v][i]);
    for (int i = 0; i < 2 && !mesh.uvs.empty(); ++i) ply.add(mesh.uvs[v][i]);
  }
  size_t face = 0;
  const auto add_faces = [&](const std::vector<uint32_t>& indices, int corners) {
    for (size_t i = 0; i < indices.size(); ++i) {
      if (i % corners == 0) ply.add_count(corners);
      ply.add(indices[i]);
      if (i % corners + 1 == static_cast<size_t>(corners) && !mesh.face_indices.empty())
        ply.add(static_cast<uint32_t>(mesh.face_indices[face++]));
    }
  };
  add_faces(mesh.triangles, 3);
  add_faces(mesh.quads, 4);
  return ply.take();
}

}  // namespace nephroid
