// The geometry of Wavefront OBJ files. It must not know scenes and materials; MTL files are named
// only. Format: Wavefront Technologies, "Object Files", Advanced Visualizer manual, appendix B1.
#pragma once

#include <string>
#include <vector>

#include "input/mesh_data.h"

namespace nephroid {

/// The faces of one object, group and material. All or none of its vertices have normals, and
/// likewise texture coordinates.
struct ObjPart {
  std::string object, group, material;  ///< names in the file; empty if it gives none
  SourceLocation where;                 ///< first face
  MeshData mesh;                        ///< triangles only
};

struct ObjLibrary {
  std::string name;  ///< name as the file gives it
  SourceLocation where;
};

struct ObjFile {
  std::vector<ObjPart> parts;  ///< none is empty; in the order of their first faces
  std::vector<ObjLibrary> libraries;
};

/// Reads an OBJ file (".gz" is unpacked).
/// - Faces with more than three corners are cut into triangles.
/// - Each corner is a vertex of its part; corners with the same indices share one.
/// - Texture coordinates have (0, 0) at the lower left of an image, as in pbrt-v4.
/// - Lines, points, free-form curves and surfaces are ignored with a warning, and so are vertex
///   colours, and smoothing groups of faces without normals.
/// Throws IoError or SceneError for a file that cannot be read, and SceneError for wrong contents.
ObjFile read_obj(SceneFiles& files, const std::string& path, const SourceLocation& wanted_by,
                 Diagnostics& diagnostics);

/// All parts as one mesh. If only some have normals, the others get (0, 0, 0), which stands for
/// the normal of the face; if only some have texture coordinates, the others get (0, 0).
MeshData joined_mesh(const ObjFile& file);

}  // namespace nephroid
