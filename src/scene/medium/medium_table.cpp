// Medium types by name; see medium_table.h.
#include "scene/medium/medium_table.h"

namespace nephroid {

namespace {

constexpr FormatParameter kCoefficients[] = {
    {"spectrum", "sigma_a", "1", "1/scene unit", "absorption; negative is an error"},
    {"spectrum", "sigma_s", "1", "1/scene unit", "scattering; negative is an error"},
    {"float", "g", "0", "", "mean cosine of scattering; outside -1 to 1 an error"},
};
constexpr FormatParameter kScale[] = {{"float", "scale", "1", "", "of sigma_a and sigma_s"}};
constexpr FormatParameter kLescale[] = {{"float", "Lescale", "1", "", "of the emission"}};
constexpr FormatParameter kBox[] = {
    {"point3", "p0", "0 0 0", "scene units", "one corner of the box"},
    {"point3", "p1", "1 1 1", "scene units", "the other corner"},
};
constexpr FormatParameter kHomogeneous[] = {
    {"string", "preset", "none", "",
     "a measured substance (\"Skin1\" ...), wins over sigma_a and sigma_s; an unknown one is an "
     "error"},
    {"spectrum", "Le", "0", "radiance", "emission, over its luminance"},
};
constexpr FormatParameter kUniformGrid[] = {
    {"float[nx ny nz]", "density", "none: an error"},
    {"integer", "nx", "1"},
    {"integer", "ny", "1"},
    {"integer", "nz", "1"},
    {"spectrum", "Le", "0", "radiance", "over its luminance; with \"temperature\" an error"},
    {"float[nx ny nz]", "Lescale", "1 at the centre", "",
     "of the emission; as in pbrt-v4 the default falls off towards the walls"},
    {"float[nx ny nz]", "temperature", "none", "K"},
};
constexpr FormatParameter kTemperature[] = {
    {"float", "temperatureoffset", "temperaturecutoff", "K"},
    {"float", "temperaturecutoff", "0", "K", "another name of temperatureoffset"},
    {"float", "temperaturescale", "1"},
};
constexpr FormatParameter kRgbGrid[] = {
    {"rgb[nx ny nz]", "sigma_a", "1", "1/scene unit", "one of sigma_a and sigma_s is needed"},
    {"rgb[nx ny nz]", "sigma_s", "1", "1/scene unit"},
    {"rgb[nx ny nz]", "Le", "none", "radiance",
     "needs sigma_a; as in pbrt-v4 not divided by its luminance"},
    {"integer", "nx", "1"},
    {"integer", "ny", "1"},
    {"integer", "nz", "1"},
    {"float", "g", "0", "", "mean cosine of scattering; outside -1 to 1 an error"},
};
constexpr FormatParameter kCloud[] = {
    {"float", "density", "1"},
    {"float", "wispiness", "1"},
    {"float", "frequency", "5"},
};
constexpr FormatParameter kNanoVdb[] = {
    {"string", "filename", "none: an error", "",
     "float fog volumes, plain or ZIP, version 32; BLOSC and other grids and versions are errors; "
     "negative voxels count as 0"},
    {"string", "gridname", "density", "", "of densities"},
    {"string", "temperaturename", "temperature", "", "of temperatures, need not be there"},
};

struct MediumRow : FormatType {
  MediumMaker make;
};
constexpr MediumRow kMedia[] = {
    {{"homogeneous", {kHomogeneous, kCoefficients, kScale, kLescale}}, make_homogeneous_medium},
    {{"uniformgrid", {kUniformGrid, kCoefficients, kScale, kTemperature, kBox}},
     make_uniform_grid_medium},
    {{"rgbgrid", {kRgbGrid, kScale, kLescale, kBox}}, make_rgb_grid_medium},
    {{"cloud", {kCloud, kCoefficients, kBox}, "has no scale"}, make_cloud_medium},
    {{"nanovdb", {kNanoVdb, kCoefficients, kScale, kLescale, kTemperature}}, make_nanovdb_medium},
};

}  // namespace

std::vector<FormatType> medium_types() {
  return format_types(kMedia);
}

std::vector<MediumPtr> make_media(const SceneDescription& description, Diagnostics& diagnostics) {
  const MediumScope scope{*description.files};
  std::vector<MediumPtr> media;
  for (const MediumDescription& d : description.media) {
    const MediumRow& row = row_of(kMedia, "medium type", d.type, d.where);
    if (!is_invertible(d.transform.start))
      throw SceneError(d.where, "the transform of medium \"" + d.name + "\" has no inverse");
    if (d.transform.is_animated())
      diagnostics.warn(d.where,
                       "medium \"" + d.name + "\" cannot move, the start of its motion is used");
    const NewMedium medium = row.make(d, scope);
    medium->set_index(static_cast<int>(media.size()));
    media.push_back(medium);
    d.parameters.report_unused("medium \"" + d.name + "\"", row, diagnostics);
  }
  return media;
}

}  // namespace nephroid
