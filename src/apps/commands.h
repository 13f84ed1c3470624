// The commands of the program, each in its own file. All return the exit status and throw Error.
#pragma once

#include "options/options.h"

namespace nephroid {

int run_render(const RenderCommand& command);
/// `render` says what is rendered.
int run_view(const ViewCommand& command, const RenderCommand& render);
int run_info(const InfoCommand& command);
int run_merge(const MergeCommand& command);
int run_mix(const MixCommand& command);
int run_compare(const CompareCommand& command);
int run_routes(const RoutesCommand& command);
int run_convert(const ConvertCommand& command);
int run_bench(const BenchCommand& command);

}  // namespace nephroid
