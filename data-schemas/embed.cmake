# SPDX-License-Identifier: BSD-3-Clause
# gonio_embed(<output.cpp> <files relative to this folder>...): writes a source that holds the files as string literals.
# Runs at configure time; editing or adding a file makes the build configure again.
function(gonio_embed output)
  set(source "// Written by data-schemas/embed.cmake.\n#include \"data-schemas/embedded_files.hpp\"\n\nnamespace gonio {\nnamespace {\n")
  string(APPEND source "constexpr EmbeddedFile files[] = {\n")
  foreach(file ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(APPEND source "    {\"${file}\", R\"_gonio_(${text})_gonio_\"},\n")
  endforeach()
  string(APPEND source "};\n}  // namespace\n\nstd::span<const EmbeddedFile> embedded_files() { return files; }\n\n}  // namespace gonio\n")
  file(CONFIGURE OUTPUT ${output} CONTENT "@source@" @ONLY)
endfunction()
