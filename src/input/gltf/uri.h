// Uniform resource identifiers of glTF files: data URIs (RFC 2397) and percent-encoded names. It
// must not know files.
#pragma once

#include <string>

#include "input/gltf/json_value.h"

namespace nephroid::gltf {

bool is_data_uri(const std::string& uri);

/// The bytes of a data URI, in base64 or percent-encoded. Throws SceneError at `uri`, whose text it
/// is, if they are damaged.
std::string data_of_uri(const std::string& text, const JsonValue& uri);

/// The name of a file. Throws SceneError at `uri` for a URI with a scheme, such as "https:".
std::string file_of_uri(const std::string& text, const JsonValue& uri);

}  // namespace nephroid::gltf
