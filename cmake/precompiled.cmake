# Headers of others that most files include, compiled once. Only those: a header of the project here would
# have everything built anew whenever it changes. Files include what they use all the same;
# -DNEPHROID_PRECOMPILED=OFF, and the debug preset, compile them without.
set(precompiled_headers
  <algorithm> <array> <atomic> <bit> <cmath> <cstddef> <cstdint> <cstring> <filesystem> <fstream> <functional>
  <limits> <map> <memory> <mutex> <numeric> <optional> <set> <span> <stdexcept> <string> <string_view>
  <unordered_map> <unordered_set> <utility> <vector>
  <ImathBox.h> <ImathMatrix.h> <ImathVec.h> <fmt/format.h>)

# TARGET takes the headers that FROM has compiled; a target that is its own source compiles them, and FURTHER
# ones too. Both need the same compiler flags.
function(nephroid_precompiled target from)
  if(NOT NEPHROID_PRECOMPILED)
    return()
  endif()
  if(target STREQUAL from)
    target_precompile_headers(${target} PRIVATE ${precompiled_headers} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()
