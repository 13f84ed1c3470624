# Headers of others that most files include, compiled once. Only those: a header of the project here would
# have everything built anew whenever it changes. Files include what they use all the same;
# -DNEPHROID_PRECOMPILED=OFF, and the debug preset, compile them without.
set(precompiled_headers
  <algorithm> <array> <atomic> <bit> <cmath> <cstddef> <cstdint> <cstring> <filesystem> <fstream> <functional>
  <limits> <map> <memory> <mutex> <numeric> <optional> <set> <span> <stdexcept> <string> <string_view>
  <unordered_map> <unordered_set> <utility> <vector>
  <ImathBox.h> <ImathMatrix.h> <ImathVec.h> <fmt/format.h>)

# Of the same concatenations g++ 12 warns in three further ways if <string> is precompiled.
if(NEPHROID_PRECOMPILED AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(nephroid_flags INTERFACE -Wno-stringop-overflow -Wno-stringop-overread
                         -Wno-array-bounds -Wno-maybe-uninitialized)
endif()

# Without times in them, clang's precompiled headers are the same in every build, and so a compiler cache knows them.
if(NEPHROID_PRECOMPILED AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(nephroid_flags INTERFACE "SHELL:-Xclang -fno-pch-timestamp")
endif()

# TARGET takes the headers that FROM has compiled; a target that is its own source compiles them, and
# those of the further arguments. Both need the same compiler flags.
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
