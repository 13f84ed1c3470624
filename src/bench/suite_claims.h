// Parses the claims of a suite file. It must not know how claims are judged (claims.h).
#pragma once

#include "bench/suite.h"
#include "bench/suite_fields.h"

namespace nephroid {

/// Parses a claim about the integrators and scenes that the suite has so far. Throws UsageError
/// with the location of the error.
BenchClaim parse_claim(const JsonValue& value, const BenchSuite& suite);

}  // namespace nephroid
