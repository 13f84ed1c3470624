// Keys of the metadata that the program writes into pictures and states. It must not know the
// values.
#pragma once

#include <string_view>

namespace nephroid {

/// Prefix of all metadata keys of the program.
inline constexpr std::string_view kKeyPrefix = "nephroid:";

// Keys of the render: the members of RenderIdentity (session/checkpoint/render_identity.h).
inline constexpr const char* kVersionKey = "nephroid:version";
inline constexpr const char* kInstructionSetKey = "nephroid:instruction_set";
inline constexpr const char* kSceneKey = "nephroid:scene";
inline constexpr const char* kSceneHashKey = "nephroid:scene_hash";
inline constexpr const char* kIntegratorKey = "nephroid:integrator";
inline constexpr const char* kFilmKey = "nephroid:film";
inline constexpr const char* kRoutesKey = "nephroid:routes";
inline constexpr const char* kAovsKey = "nephroid:aovs";
inline constexpr const char* kLayersByLightKey = "nephroid:layers_by_light";
inline constexpr const char* kOptionsKey = "nephroid:options";
inline constexpr const char* kOutliersKey = "nephroid:outliers";
inline constexpr const char* kMaxComponentKey = "nephroid:max_component";
inline constexpr const char* kSeedKey = "nephroid:seed";
// Key of the film, read by the program only (film_metadata.h).
inline constexpr const char* kLayoutKey = "nephroid:layout";
// Keys of the progress (checkpoint.h).
inline constexpr const char* kPassesKey = "nephroid:passes";
inline constexpr const char* kOpenPassKey = "nephroid:unfinished_pass";
inline constexpr const char* kSecondsKey = "nephroid:seconds";
inline constexpr const char* kHistoryKey = "nephroid:history";
inline constexpr const char* kChoicesKey = "nephroid:choices";
inline constexpr const char* kOutlierEstimatesKey = "nephroid:outlier_estimates";
inline constexpr const char* kEstimatesKey = "nephroid:estimates:";  ///< + name of a route
// Key of a mix (image/mix.h).
inline constexpr const char* kMixKey = "nephroid:mix";

}  // namespace nephroid
