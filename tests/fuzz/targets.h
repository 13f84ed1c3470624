// What is fuzzed: each target reads hostile bytes and may only return or throw an Error that it
// catches itself; anything else (a crash, another exception, a hang) is a finding.
// Who calls it: libFuzzer (libfuzzer/entry.cpp) and the replay of the corpus in `make test`.
#pragma once

#include <string>

namespace nephroid::fuzz {

/// A scene text with the files that it may include: a line "#file NAME" starts the next file.
void scene(const std::string& bytes);
/// A PLY file.
void ply(const std::string& bytes);
/// A file of measured reflection; what can be read is also evaluated and sampled.
void bsdf(const std::string& bytes);
/// A file of routes, with lines "--aov NAME=EXPRESSION" among them; what can be read is compiled
/// and proved, and its tables must agree with themselves from both ends.
void routes(const std::string& bytes);

/// An image file, read whole, as it is stored, and tile by tile.
void image(const std::string& bytes);
/// An image file as the lights that take one have it; what can be read is sampled.
void environment(const std::string& bytes);
/// A NanoVDB file, or changes to a sound one; what can be read is looked up and walked through.
void nanovdb(const std::string& bytes);
/// A picture with the state of a render, read without its scene; or words of held outliers.
void checkpoint(const std::string& bytes);
/// A command line, an argument a line.
void command(const std::string& bytes);

}  // namespace nephroid::fuzz
