// Fuzz targets: each reads hostile bytes and may only return or throw an Error that it catches
// itself. A crash, another exception or a hang is a finding. libFuzzer (libfuzzer/entry.cpp) and
// the replay of the corpus in `make test` run them.
#pragma once

#include <string>

namespace nephroid::fuzz {

/// A scene text and the files it may include: a line "#file NAME" starts the next file.
void scene(const std::string& bytes);
/// A Mitsuba scene and the files it names, in the same form; the first is "scene.xml".
void mitsuba(const std::string& bytes);
/// A .serialized file; or, without its magic number, the unpacked contents of one mesh.
void serialized(const std::string& bytes);
/// A .vol file.
void volume(const std::string& bytes);
/// A PLY file.
void ply(const std::string& bytes);
/// An OBJ file and the files of materials that it may name, as in `scene`.
void obj(const std::string& bytes);
/// A glTF file, either container.
void gltf(const std::string& bytes);
/// A measured BSDF; a valid one is also evaluated and sampled.
void bsdf(const std::string& bytes);
/// A file of routes, which may contain lines "--aov NAME=EXPRESSION". Valid ones are compiled and
/// proved, and their tables must agree from both ends.
void routes(const std::string& bytes);

/// An image file, read whole, in its stored encoding, and tile by tile.
void image(const std::string& bytes);
/// An image file as lights read it; a valid one is sampled.
void environment(const std::string& bytes);
/// A NanoVDB file, or changes to a valid one. Valid grids are looked up and traversed.
void nanovdb(const std::string& bytes);
/// A picture with a render state, read without its scene; or words of held outliers.
void checkpoint(const std::string& bytes);
/// Changes to what integrators have learned for a small scene. Then they render a pass.
void learned(const std::string& bytes);
/// A command line, one argument per line.
void command(const std::string& bytes);
/// The body of a request to the view, or one of its headers.
void view_request(const std::string& bytes);

}  // namespace nephroid::fuzz
