// Describes a live render for its page, and applies the page's changes to its request.
#pragma once

#include <string>
#include <vector>

#include "session/render.h"
#include "view/live_state.h"
#include "view/view_requests.h"

namespace nephroid {

/// Applies the changes that begin anew.
void apply(const RenderChange& change, RenderRequest* request);

/// Sets what the state says of a render before its first picture.
void describe(const Render& render, const LoadedScene& loaded, bool is_preview, LiveState* state);
/// `full` is the film without preview.
LiveSettings settings_of(const RenderRequest& request, const Render& render, const Scene& scene,
                         const FilmDescription& full);

/// Those of the names that are names of layers.
std::vector<std::string> known_layers(const std::vector<LiveLayer>& layers,
                                      const std::vector<std::string>& names);

/// The lines of a text, without the newlines.
std::vector<std::string> lines_of(const std::string& text);
/// Reasons as one text.
std::string joined(const std::vector<std::string>& reasons);

}  // namespace nephroid
