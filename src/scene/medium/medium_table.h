// The table of medium types (the scene format's name and its maker), and parameters that several
// types share. A new medium is one file with its maker and one row in medium_table.cpp. The makers
// must not know the rest of the scene.
#pragma once

#include "core/spectra_dense.h"
#include "input/format_rows.h"
#include "scene/medium/medium.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// The parts of the scene that a maker needs besides its directive.
struct MediumScope {
  SceneFiles& files;
};

/// All types of the format.
std::vector<FormatType> medium_types();

/// A medium that is not part of a scene yet.
using NewMedium = std::shared_ptr<Medium>;
using MediumMaker = NewMedium (*)(const MediumDescription&, const MediumScope&);

// The makers, one per file. They throw SceneError for bad parameters.
NewMedium make_homogeneous_medium(const MediumDescription&, const MediumScope&);
NewMedium make_uniform_grid_medium(const MediumDescription&, const MediumScope&);
NewMedium make_rgb_grid_medium(const MediumDescription&, const MediumScope&);
NewMedium make_cloud_medium(const MediumDescription&, const MediumScope&);
NewMedium make_nanovdb_medium(const MediumDescription&, const MediumScope&);

/// Absorption and scattering per unit of density, 1/length, looked up at the nearest nanometre as
/// in pbrt-v4.
struct Extinction {
  DenseSpectrum sigma_a, sigma_s;
};
/// Reads "sigma_a" and "sigma_s" times `scale`, each 1 by default.
Extinction read_extinction(const ParameterSet& parameters, float scale, SceneFiles& files);

/// `spectrum` times `scale` as a table. Throws SceneError at `where` if it is negative anywhere or
/// overflows.
DenseSpectrum dense_spectrum(const Spectrum& spectrum, float scale, const SourceLocation& where,
                             const std::string& name);

/// Reads "Le" times `scale` over the luminance of "Le", as radiance. Black if absent or black.
DenseSpectrum read_emission(const ParameterSet& parameters, float scale, SceneFiles& files);

/// Reads a float that is finite and not negative.
float read_factor(const ParameterSet& parameters, const std::string& name, float fallback);

/// Reads "scale", the factor of the coefficients, 1 by default.
inline float read_scale(const ParameterSet& parameters) {
  return read_factor(parameters, "scale", 1.0f);
}

/// Reads "g" as a phase function. Throws SceneError outside [-1, 1].
HenyeyGreenstein read_phase(const ParameterSet& parameters);

}  // namespace nephroid
