# SPDX-License-Identifier: BSD-3-Clause
# Writes OUTPUT, a C++ source with the content of FILES: cmake -DOUTPUT=... "-DFILES=a.js;b.css" -P embed_web.cmake
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" content)
  string(FIND "${content}" ")embedded\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${file} holds what ends a string of the source")
  endif()
  string(APPEND entries "    {\"${name}\", R\"embedded(${content})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Written by embed_web.cmake.
#include \"base/web_files.hpp\"

#include <stdexcept>

namespace urban_nav {

std::string_view webFile(std::string_view name) {
  static constexpr struct {
    std::string_view name, content;
  } kFiles[] = {
${entries}  };
  for (const auto& file : kFiles)
    if (file.name == name) return file.content;
  throw std::out_of_range(\"no embedded file \" + std::string(name));
}

}  // namespace urban_nav
")
