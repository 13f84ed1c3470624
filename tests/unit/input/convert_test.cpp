// A scene that was written as pbrt-v4 reads as the same scene: the same directives, and meshes and
// files with the same contents.
#include <gtest/gtest.h>

#include <filesystem>

#include "input/convert/companion_files.h"
#include "input/convert/pbrt_text.h"
#include "input/convert/pbrt_writer.h"
#include "input/convert/ply_writer.h"
#include "input/file_bytes.h"
#include "input/mesh_directive.h"
#include "input/parameter_list.h"
#include "input/pbrt_parser.h"
#include "source_directory.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;

/// A description as text that does not depend on where its files are and how meshes are written.
class Canonical {
 public:
  explicit Canonical(const SceneDescription& scene) : scene_(scene) {
    for (const Parameter& option : scene.options) add(option);
    add("film", scene.film, scene.color_space);
    add("sampler", scene.sampler);
    add("filter", scene.pixel_filter);
    add("integrator", scene.integrator);
    add("accelerator", scene.accelerator);
    if (scene.camera) {
      add("camera " + scene.camera->medium, *scene.camera);
      add(scene.camera->world_to_camera);
    }
    text_ +=
        shortest_text(scene.transform_start_time) + shortest_text(scene.transform_end_time) + "\n";
    for (const MaterialDescription& m : scene.materials) add("material", m);
    for (const TextureDescription& t : scene.textures) {
      add("texture " + t.name + " " + t.value_type, t);
      add(t.transform);
    }
    for (const MediumDescription& m : scene.media) {
      add("medium " + m.name, m);
      add(m.transform);
    }
    for (const LightDescription& light : scene.lights) {
      add("light in " + light.medium, light);
      add(light.transform);
    }
    for (const ShapeDescription& shape : scene.shapes) add(shape);
    for (const auto& object : scene.objects) {
      text_ += "object " + object.first + "\n";
      for (const ShapeDescription& shape : object.second.shapes) add(shape);
    }
    for (const InstanceDescription& instance : scene.instances) {
      text_ += "instance " + instance.object + "\n";
      add(instance.transform);
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string contents(const std::string& name) const {
    if (const auto bytes = scene_.files->in_memory(name)) return *bytes;
    const std::string path = scene_.files->path_of(name);
    return fs::is_regular_file(path) ? read_file_bytes(path) : name;
  }
  static std::string short_form(const std::string& bytes) {
    return std::to_string(bytes.size()) + ":" + std::to_string(std::hash<std::string>()(bytes));
  }
  void add(const Parameter& p, bool is_of_film = false) {
    if (p.name == "type") return;
    Parameter shown = p;
    if (!is_of_film && (p.type == "string" || p.type == "spectrum"))
      for (std::string& text : shown.strings) text = short_form(contents(text));
    text_ += parameter_text(shown) + " " + p.color_space + "\n";
  }
  void add(const std::string& what, const DirectiveDescription& d) {
    text_ += what + " " + (d.type.empty() ? "interface" : d.type) + "\n";
    for (const Parameter& p : d.parameters.list) add(p);
  }
  void add(const std::string& what, const std::optional<DirectiveDescription>& d,
           const std::string& suffix = "") {
    if (!d) return;
    text_ += what + " " + d->type + suffix + "\n";
    for (const Parameter& p : d->parameters.list) add(p, what == "film");
  }
  void add(const TransformDescription& t) {
    text_ += matrix_text(t.start) + matrix_text(t.end) + "\n";
  }
  std::optional<MeshData> mesh_of(const ShapeDescription& shape) const {
    if (shape.type != "plymesh") return mesh_for_a_file(shape);
    return read_ply(*scene_.files,
                    scene_.files->path_of(shape.parameters.get_string("filename", "")), {});
  }
  size_t material_of(const ShapeDescription& shape) const {
    if (shape.material.index >= 0) return static_cast<size_t>(shape.material.index);
    for (size_t i = 0; i < scene_.materials.size(); ++i)
      if (scene_.materials[i].name == shape.material.name) return i;
    return scene_.materials.size();
  }
  void add(const ShapeDescription& shape) {
    text_ += "shape " + std::to_string(material_of(shape)) + " " + shape.inside_medium + "|" +
             shape.outside_medium + (shape.reverse_orientation ? " reversed\n" : "\n");
    add(shape.transform);
    if (const std::optional<MeshData> mesh = mesh_of(shape)) {
      text_ += short_form(ply_bytes(*mesh)) + "\n";
      for (const Parameter& p : shape.parameters.list)
        if (p.name == "alpha" || p.name == "displacement") add(p);
    } else {
      add("", shape);
    }
    if (shape.area_light) add("area light", *shape.area_light);
  }

  const SceneDescription& scene_;
  std::string text_;
};

std::string canonical(const SceneDescription& scene) {
  return Canonical(scene).text();
}

SceneDescription read(const std::string& path) {
  Diagnostics diagnostics;
  return parse_pbrt_file(path, diagnostics);
}

void expect_round_trip(const SceneDescription& scene) {
  const TemporaryDirectory folder;
  const std::string once = folder.path("once/scene.pbrt"), twice = folder.path("twice/scene.pbrt");
  fs::create_directories(folder.path("once"));
  fs::create_directories(folder.path("twice"));
  write_pbrt(scene, once);
  const SceneDescription again = read(once);
  EXPECT_EQ(canonical(again), canonical(scene));
  write_pbrt(again, twice);
  EXPECT_EQ(canonical(read(twice)), canonical(scene));
}

TEST(Convert, KeepsTheScenesOfTheProject) {
  int scenes = 0;
  for (const char* folder : {"scenes", "tests/unit/input/golden"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(testing_support::source_directory()) / folder)) {
      if (entry.path().extension() != ".pbrt") continue;
      if (read_file_bytes(entry.path().string()).find("\nWorldBegin") == std::string::npos)
        continue;  // a part of another scene
      SCOPED_TRACE(entry.path().string());
      expect_round_trip(read(entry.path().string()));
      ++scenes;
    }
  EXPECT_GE(scenes, 25);
}

TEST(Convert, WritesMeshesAndImagesBesideTheScene) {
  MeshData mesh;
  for (uint32_t i = 0; i < 40; ++i) {
    mesh.positions.emplace_back(static_cast<float>(i) / 3, static_cast<float>(i % 3), 1e-7f);
    mesh.normals.emplace_back(0, 0, 1);
    mesh.uvs.emplace_back(0.1f, static_cast<float>(i));
    mesh.triangles.insert(mesh.triangles.end(), {i, (i + 1) % 40, (i + 2) % 40});
    mesh.face_indices.push_back(static_cast<int>(i) - 7);
  }
  SceneDescription scene = testing::parse("WorldBegin\nShape \"sphere\"\n");
  ShapeDescription& shape = scene.shapes.emplace_back(scene.shapes.front());
  static_cast<DirectiveDescription&>(shape) = mesh_directive(mesh, {});
  scene.files->add_in_memory("m.glb#/images/0", "\x89PNG and so on");
  ParameterList image{SourceLocation()};
  image.add_string("filename", "m.glb#/images/0");
  for (const char* name : {"a", "b \"quoted\" \\ name"}) {
    TextureDescription& texture = scene.textures.emplace_back();
    ParameterList copy = image;
    static_cast<DirectiveDescription&>(texture) = std::move(copy).directive("imagemap");
    texture.name = name;
    texture.value_type = "spectrum";
  }
  expect_round_trip(scene);

  const TemporaryDirectory folder;
  write_pbrt(scene, folder.path("out.pbrt"));
  EXPECT_EQ(read_file_bytes(folder.path("out-1.png")), "\x89PNG and so on");  // once for both
  SceneFiles files;
  const MeshData read_back = read_ply(files, folder.path("out-2.ply"), {});
  EXPECT_EQ(read_back.positions, mesh.positions);
  EXPECT_EQ(read_back.normals, mesh.normals);
  EXPECT_EQ(read_back.uvs, mesh.uvs);
  EXPECT_EQ(read_back.triangles, mesh.triangles);
  EXPECT_EQ(read_back.face_indices, mesh.face_indices);
}

TEST(Convert, ReplacesNoOtherFile) {
  SceneDescription scene = testing::parse("WorldBegin\nShape \"sphere\"\n");
  scene.files->add_in_memory("m.glb#/images/0", "\x89PNG and so on");
  ParameterList image{SourceLocation()};
  image.add_string("filename", "m.glb#/images/0");
  TextureDescription& texture = scene.textures.emplace_back();
  static_cast<DirectiveDescription&>(texture) = std::move(image).directive("imagemap");
  texture.name = "a";
  texture.value_type = "spectrum";
  const TemporaryDirectory folder;
  folder.write("out-1.png", "somebody's picture");
  for (int again = 0; again < 2; ++again) {
    EXPECT_EQ(write_pbrt(scene, folder.path("out.pbrt")), std::vector<std::string>{"out-2.png"});
    EXPECT_EQ(read_file_bytes(folder.path("out-1.png")), "somebody's picture");
    EXPECT_EQ(read_file_bytes(folder.path("out-2.png")), "\x89PNG and so on");
    EXPECT_NE(read_file_bytes(folder.path("out.pbrt")).find("\"out-2.png\""), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder.path("out-3.png")));
  }
}

TEST(Convert, WritesTheFacesOfACube) {
  SceneDescription scene = testing::parse("WorldBegin\nShape \"sphere\"\n");
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i) {
    names.push_back("m.glb#/images/" + std::to_string(i));
    scene.files->add_in_memory(names.back(), "\x89PNG of face " + std::to_string(i));
  }
  ParameterList list{SourceLocation()};
  list.add_strings("faces", names);
  static_cast<DirectiveDescription&>(scene.lights.emplace_back()) =
      std::move(list).directive("infinite");
  const TemporaryDirectory folder;
  write_pbrt(scene, folder.path("out.pbrt"));
  const SceneDescription written = read(folder.path("out.pbrt"));
  const Parameter* faces = written.lights.at(0).parameters.find("faces");
  ASSERT_TRUE(faces);
  ASSERT_EQ(faces->strings.size(), 6u);
  for (size_t i = 0; i < 6; ++i)
    EXPECT_EQ(read_file_bytes(folder.path(faces->strings[i])),
              "\x89PNG of face " + std::to_string(i));
  EXPECT_NE(read_file_bytes(folder.path("out.pbrt")).find("\"string faces\" of infinite lights"),
            std::string::npos);
}

TEST(Convert, NamesMaterialsAsLightPathExpressionsDo) {
  const TemporaryDirectory folder;
  write_pbrt(
      testing::parse("WorldBegin\nMakeNamedMaterial \"diffuse1\" \"string type\" \"conductor\"\n"
                     "Material \"diffuse\"\nShape \"sphere\"\nMaterial \"\"\nShape \"disk\"\n"),
      folder.path("m.pbrt"));
  const SceneDescription scene = read(folder.path("m.pbrt"));
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[1].name, "diffuse2");
  EXPECT_EQ(scene.shapes[0].material.name, "diffuse2");
  EXPECT_EQ(scene.materials[2].type, "interface");
}

TEST(Convert, SaysWhatIsNotPbrts) {
  const TemporaryDirectory folder;
  const auto text = [&](const std::string& scene) {
    write_pbrt(testing::parse(scene), folder.path("d.pbrt"));
    return read_file_bytes(folder.path("d.pbrt"));
  };
  EXPECT_EQ(text("WorldBegin\n").find("Nephroid, not"), std::string::npos);
  EXPECT_NE(text("WorldBegin\nMaterial \"principled\"\nShape \"sphere\"\n"
                 "LightSource \"distant\" \"float angle\" 1\n")
                .find("# Of Nephroid, not of pbrt-v4: \"float angle\" of distant lights, material "
                      "\"principled\".\n"),
            std::string::npos);
  EXPECT_NE(text("WorldBegin\nTexture \"t\" \"float\" \"imagemap\" \"string filename\" \"a.png\" "
                 "\"string wrap\" \"mirror\" \"string channel\" \"a\"\n"
                 "ObjectBegin \"o\"\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] "
                 "\"point2 uv2\" [ 0 0 1 0 0 1 ]\nObjectEnd\n")
                .find("# Of Nephroid, not of pbrt-v4: \"point2 uv2\" of trianglemesh shapes, "
                      "\"string channel\" of imagemap textures, \"string wrap\" \"mirror\" of "
                      "imagemap textures.\n"),
            std::string::npos);
}

TEST(Convert, AnUnwritableFileIsAnError) {
  EXPECT_THROW(write_pbrt(testing::parse("WorldBegin\n"), "/nonexistent/folder/a.pbrt"), IoError);
}

}  // namespace
}  // namespace nephroid
