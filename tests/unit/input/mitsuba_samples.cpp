#include "unit/input/mitsuba_samples.h"

#include "unit/input/mitsuba_files.h"

namespace nephroid::testing {
namespace {

std::string file(const std::string& name) {
  return "<string name=\"filename\" value=\"" + name + "\"/>";
}

using Samples = std::vector<PluginSample>;

const std::string kNested = "<bsdf type=\"diffuse\"/>";
const std::string kMetal = "<bsdf type=\"conductor\"/>";
const std::string kBall = "<shape type=\"sphere\"/>";
const std::string kPath = "<integrator type=\"path\"/>";
const std::string kBitmap = "<texture type=\"bitmap\">" + file("image.png") + "</texture>";
const std::string kGroup = "<shape type=\"shapegroup\" id=\"group\">" + kBall + "</shape>";
const std::string kGrid =
    "<volume name=\"density\" type=\"gridvolume\">" + file("grid.vol") + "</volume>";
const std::string kColor = value("rgb", "color", "0.1 0.2 0.3");

const Samples kShapes = {
    {"shape", "obj", {"shape 'trianglemesh'", "'P' = 0 0 0 1 0 0 0 1 0"}, file("mesh.obj")},
    {"shape", "ply", {"shape 'trianglemesh'", "'P' = 0 0 0 1 0 0 0 1 0"}, file("mesh.ply")},
    {"shape", "serialized", {"shape 'trianglemesh'", "'indices' = 0 1 2"}, file("mesh.serialized")},
    {"shape", "rectangle", {"shape 'trianglemesh'", "'P' = -1 -1 0 1 -1 0 1 1 0 -1 1 0"}},
    {"shape", "cube", {"shape 'trianglemesh'", "'indices' = 0 1 2 0 2 3 4 5 6"}},
    {"shape", "sphere", {"shape 'sphere'", "'radius' = 2"}, value("float", "radius", "2")},
    {"shape", "disk", {"shape 'disk'"}},
    {"shape", "cylinder", {"shape 'cylinder'", "'zmin' = 0", "'zmax' = 1"}},
    {"shape", "hair", {"shape 'curve'", "'basis' = 'bezier'"}, file("hair.txt")},
    {"shape", "bsplinecurve", {"shape 'curve'", "'basis' = 'bspline'"}, file("curves.txt")},
    {"shape", "linearcurve", {"shape 'curve'", "'basis' = 'bezier'"}, file("curves.txt")},
    {"shape", "shapegroup", {"object 'it'", "shape 'sphere'"}, kBall},
    {"shape", "instance", {"object 'group'", "instance 'group'"}, kGroup},
    {"shape", "merge", {"shape 'sphere'", "shape 'disk'"}, kBall + "<shape type=\"disk\"/>"},
};

const Samples kBsdfs = {
    {"bsdf", "diffuse", {"material 'diffuse'", "'reflectance' = 0.5 0.5 0.5"}},
    {"bsdf", "roughdiffuse", {"material 'principled'", "float 'base_diffuse_roughness'"}},
    {"bsdf", "dielectric", {"material 'dielectric'", "float 'eta' = 1.504"}},
    {"bsdf", "thindielectric", {"material 'thindielectric'", "float 'eta' = 1.504"}},
    {"bsdf", "roughdielectric", {"material 'dielectric'", "'roughness' = 0.1", "eta"}},
    {"bsdf", "conductor", {"material 'conductor'", "'eta' = 'metal-Cu-eta'"}},
    {"bsdf", "roughconductor", {"material 'conductor'", "'remaproughness' = false"}},
    {"bsdf", "plastic", {"material 'coateddiffuse'", "float 'eta' = 1.489"}},
    {"bsdf", "roughplastic", {"material 'coateddiffuse'", "'roughness' = 0.1"}},
    {"bsdf", "coating", {"material 'coateddiffuse'", "'reflectance' = 0.5 0.5 0.5"}, kNested},
    {"bsdf", "roughcoating", {"material 'coatedconductor'", "'conductor.eta'"}, kMetal},
    {"bsdf", "bumpmap", {"texture 'displacement' = ", "texture 'imagemap'"}, kBitmap + kNested},
    {"bsdf", "normalmap", {"'normalmap' = 'image.png'"}, kBitmap + kNested},
    {"bsdf", "mask", {"shape 'sphere'", "float 'alpha' = 0.5"}, kNested},
    {"bsdf", "blendbsdf", {"material 'mix'", "'amount' = 0.5"}, kNested + kMetal},
    {"bsdf",
     "mixturebsdf",
     {"material 'mix'", "'amount' = 0.6"},
     value("string", "weights", "0.4, 0.6") + kNested + kMetal},
    {"bsdf", "twosided", {"material 'diffuse'"}, kNested},
    {"bsdf", "phong", {"material 'mix'", "material 'diffuse'", "material 'conductor'"}},
    {"bsdf", "ward", {"material 'mix'", "'uroughness' = 0.1", "'vroughness' = 0.1"}},
    {"bsdf", "difftrans", {"material 'diffusetransmission'", "'transmittance' = 0.5 0.5 0.5"}},
    {"bsdf", "null", {"material 'interface'"}},
    {"bsdf", "principled", {"material 'principled'", "'specular_roughness' = 0.5"}},
    {"bsdf", "principledthin", {"material 'principled'", "'geometry_thin_walled' = true"}},
    {"bsdf", "measured", {"material 'measured'", "'metal.bsdf'"}, file("metal.bsdf")},
    {"bsdf", "hair", {"material 'hair'", "'eumelanin' = 1.3"}},
    {"bsdf", "pplastic", {"material 'coateddiffuse'", "'roughness' = 0.1"}},
};

const Samples kSubsurface = {
    {"subsurface", "dipole", {"material 'subsurface'", "'name' = 'Skin1'", "'eta' = 1.3"}},
    {"subsurface", "singlescatter", {"material 'diffuse'"}},
};

const Samples kColors = {
    {"texture", "bitmap", {"spectrum texture 'imagemap'", "'image.png'"}, file("image.png")},
    {"texture", "checkerboard", {"spectrum texture 'checkerboard'", "'tex1' = 0.4 0.4 0.4"}},
    {"texture",
     "scale",
     {"spectrum texture 'scale'", "'scale' = 0.5"},
     value("float", "scale", "0.5") + kBitmap},
    {"texture", "vertexcolors", {"spectrum texture 'vertexcolor'"}},
    {"texture", "mesh_attribute", {"spectrum texture 'vertexcolor'"}},
    {"spectrum", "uniform", {"spectrum 'L' = 360 2 830 2"}, value("float", "value", "2")},
    {"spectrum", "d65", {"rgb 'L' = 0.1 0.2 0.3"}, kColor},
    {"spectrum", "srgb", {"rgb 'L' = 0.1 0.2 0.3"}, kColor},
    {"spectrum",
     "regular",
     {"spectrum 'L' = 360 1 595 2 830 3"},
     value("string", "values", "1, 2, 3")},
    {"spectrum",
     "irregular",
     {"spectrum 'L' = 400 1 700 2"},
     value("string", "wavelengths", "400, 700") + value("string", "values", "1, 2")},
    {"spectrum", "blackbody", {"blackbody 'L' = 5000"}, value("float", "temperature", "5000")},
    {"spectrum", "rawconstant", {"spectrum 'L' = 360 2 830 2"}, value("float", "value", "2")},
};

const Samples kEmitters = {
    {"emitter", "area", {"area light 'diffuse'", "rgb 'L' = 1 1 1"}},
    {"emitter", "point", {"light 'point'", "rgb 'I' = 1 1 1"}},
    {"emitter", "spot", {"light 'spot'", "'coneangle' = 20", "'conedeltaangle' = 5"}},
    {"emitter", "directional", {"light 'distant'", "rgb 'L' = 1 1 1"}},
    {"emitter", "constant", {"light 'infinite'", "rgb 'L' = 1 1 1"}},
    {"emitter", "envmap", {"light 'infinite'", "'filename' = 'sky.exr'"}, file("sky.exr")},
    {"emitter", "sky", {"light 'infinite'", "'filename' = 'it#/sky.pfm'"}},
    {"emitter", "sun", {"light 'distant'", "float 'angle' = 0.5"}},
    {"emitter", "sunsky", {"light 'distant'", "light 'infinite'"}},
};

const Samples kSensors = {
    {"sensor", "perspective", {"camera 'perspective'", "float 'fov'"}},
    {"sensor", "thinlens", {"'lensradius' = 0.5"}, value("float", "apertureRadius", "0.5")},
    {"sensor", "orthographic", {"camera 'orthographic'", "= -1 1 -0.75 0.75"}},
    {"film", "hdrfilm", {"'xresolution' = 768", "'yresolution' = 576"}},
    {"film", "tiledhdrfilm", {"'xresolution' = 768"}},
    {"film", "mfilm", {"'xresolution' = 9"}, value("integer", "width", "9")},
    {"film", "ldrfilm", {"'xresolution' = 9"}, value("integer", "width", "9")},
    {"film", "specfilm", {"'xresolution' = 9"}, value("integer", "width", "9")},
    {"rfilter", "box", {"filter 'box'", "'xradius' = 0.5", "'yradius' = 0.5"}},
    {"rfilter", "tent", {"filter 'triangle'", "'xradius' = 1"}},
    {"rfilter", "gaussian", {"filter 'gaussian'", "'sigma' = 0.5", "'xradius' = 2"}},
    {"rfilter", "mitchell", {"filter 'mitchell'", "'B' = 0.333333333"}},
    {"rfilter", "catmullrom", {"filter 'mitchell'", "'B' = 0", "'C' = 0.5"}},
    {"rfilter", "lanczos", {"filter 'sinc'", "'xradius' = 3", "'tau' = 3"}},
};

const Samples kMedia = {
    {"medium", "homogeneous", {"medium 'homogeneous'", "'preset' = 'Skin1'", "'scale' = 100"}},
    {"medium", "heterogeneous", {"medium 'uniformgrid'", "'density' = 0 1 2 3 4 5 6 7"}, kGrid},
    {"phase", "isotropic", {"medium 'homogeneous'"}},
    {"phase", "hg", {"float 'g' = 0.4"}, value("float", "g", "0.4")},
    {"phase", "rayleigh", {"medium 'homogeneous'"}},
    {"volume", "constvolume", {"'sigma_s' = 1.5 1.5 1.5"}, value("float", "value", "2")},
    {"volume", "gridvolume", {"medium 'uniformgrid'", "'nx' = 2"}, file("grid.vol")},
};

const Samples kIntegrators = {
    {"integrator", "path", {"integrator 'path'"}},
    {"integrator", "volpath", {"integrator 'volpath'"}},
    {"integrator", "volpath_simple", {"integrator 'volpath'"}},
    {"integrator", "volpathmis", {"integrator 'volpath'"}},
    {"integrator", "prb", {"integrator 'path'"}},
    {"integrator", "prb_basic", {"integrator 'path'"}},
    {"integrator", "prbvolpath", {"integrator 'volpath'"}},
    {"integrator", "direct", {"integrator 'path'", "'maxdepth' = 1"}},
    {"integrator", "bdpt", {"integrator 'bdpt'"}},
    {"integrator", "mlt", {"integrator 'mlt'"}},
    {"integrator", "pssmlt", {"integrator 'mlt'"}},
    {"integrator", "erpt", {"integrator 'mlt'"}},
    {"integrator", "ptracer", {"integrator 'lightpath'"}},
    {"integrator", "photonmapper", {"integrator 'sppm'"}},
    {"integrator", "ppm", {"integrator 'sppm'"}},
    {"integrator", "sppm", {"integrator 'sppm'"}},
    {"integrator", "adaptive", {"integrator 'path'"}, kPath},
    {"integrator", "irrcache", {"integrator 'path'"}, kPath},
    {"integrator", "multichannel", {"integrator 'path'"}, kPath},
    {"integrator", "aov", {"integrator 'path'"}, kPath},
    {"integrator", "moment", {"integrator 'path'"}, kPath},
    {"integrator", "stokes", {"integrator 'path'"}, kPath},
    {"integrator", "vpl", {"integrator 'volpath'"}},
    {"integrator", "ao", {"integrator 'volpath'"}},
    {"integrator", "field", {"integrator 'volpath'"}},
    {"integrator", "depth", {"integrator 'volpath'"}},
    {"integrator", "motion", {"integrator 'volpath'"}},
};

}  // namespace

const Samples& plugin_samples() {
  static const Samples samples = [] {
    Samples all;
    for (const Samples* part :
         {&kShapes, &kBsdfs, &kSubsurface, &kColors, &kEmitters, &kSensors, &kMedia, &kIntegrators})
      all.insert(all.end(), part->begin(), part->end());
    return all;
  }();
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
  if (tag == "bsdf" || tag == "subsurface" || (tag == "emitter" && name == "area"))
    return in_shape(named(""));
  if (tag == "texture")
    return in_shape("<bsdf type=\"diffuse\">" + named("reflectance") + "</bsdf>");
  if (tag == "spectrum")
    return in_shape("<emitter type=\"area\">" + named("radiance") + "</emitter>");
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
