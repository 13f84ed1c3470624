#include "unit/input/mitsuba_samples.h"

#include "unit/input/mitsuba_files.h"

namespace nephroid::testing {
namespace {

std::string file(const std::string& name) {
  return "<string name=\"filename\" value=\"" + name + "\"/>";
}

const std::string kNested = "<bsdf type=\"diffuse\"/>";
const std::string kBitmap = "<texture type=\"bitmap\">" + file("image.png") + "</texture>";
const std::string kGroup =
    "<shape type=\"shapegroup\" id=\"group\"><shape type=\"sphere\"/></shape>";

}  // namespace

const std::vector<PluginSample>& plugin_samples() {
  static const std::vector<PluginSample> samples = {
      {"bsdf", "twosided", kNested},
      {"bsdf", "mask", kNested},
      {"bsdf", "coating", kNested},
      {"bsdf", "roughcoating", "<bsdf type=\"conductor\"/>"},
      {"bsdf", "blendbsdf", kNested + "<bsdf type=\"conductor\"/>"},
      {"bsdf", "mixturebsdf",
       "<string name=\"weights\" value=\"0.4, 0.6\"/>" + kNested + "<bsdf type=\"null\"/>"},
      {"bsdf", "bumpmap", kBitmap + kNested},
      {"bsdf", "normalmap", kBitmap + kNested},
      {"bsdf", "measured", file("metal.bsdf")},
      {"shape", "obj", file("mesh.obj")},
      {"shape", "ply", file("mesh.ply")},
      {"shape", "serialized", file("mesh.serialized")},
      {"shape", "hair", file("hair.txt")},
      {"shape", "bsplinecurve", file("curves.txt")},
      {"shape", "linearcurve", file("curves.txt")},
      {"shape", "instance", kGroup},
      {"texture", "bitmap", file("image.png")},
      {"texture", "scale", "<float name=\"scale\" value=\"0.5\"/>" + kBitmap},
      {"emitter", "envmap", file("sky.exr")},
      {"volume", "gridvolume", file("grid.vol")},
  };
  return samples;
}

void write_sample_files(const TemporaryDirectory& folder) {
  folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("mesh.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("mesh.serialized", serialized_file({SerializedSample()}));
  folder.write("hair.txt", "0 0 0\n0 0 1\n\n1 0 0\n1 0 1\n");
  folder.write("curves.txt", "0 0 0 1\n0 0 1 1\n0 0 2 1\n0 0 3 1\n");
  folder.write("grid.vol", volume_file(VolumeSample()));
}

std::string scene_with(const std::string& tag, const std::string& name, const std::string& body) {
  const std::string plugin =
      "<" + tag + " type=\"" + name + "\" id=\"it\" NAME>" + body + "</" + tag + ">";
  const auto named = [&](const std::string& property) {
    std::string text = plugin;
    const std::string attribute = property.empty() ? "" : "name=\"" + property + "\"";
    return text.replace(text.find("NAME"), 4, attribute);
  };
  const auto in_shape = [](const std::string& inside) {
    return "<shape type=\"sphere\">" + inside + "</shape>\n";
  };
  const auto in_medium = [&](const std::string& inside) {
    return in_shape("<medium name=\"interior\" type=\"heterogeneous\">" + inside + "</medium>");
  };
  if (tag == "bsdf" || (tag == "emitter" && name == "area")) return in_shape(named(""));
  if (tag == "texture")
    return in_shape("<bsdf type=\"diffuse\">" + named("reflectance") + "</bsdf>");
  if (tag == "medium") return in_shape(named("interior"));
  if (tag == "phase") return in_medium(named(""));
  if (tag == "volume") return in_medium(named("density"));
  if (tag == "film") return "<sensor type=\"perspective\">" + named("") + "</sensor>\n";
  if (tag == "rfilter")
    return "<sensor type=\"perspective\"><film type=\"hdrfilm\">" + named("") +
           "</film></sensor>\n";
  return named("") + "\n";
}

}  // namespace nephroid::testing
