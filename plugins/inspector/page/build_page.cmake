# Run while building: packages by `npm ci` into BUILD, the bundle into BUILD/page, and OUTPUT, a C++
# source that has its files as bytes. Without a network there is no page, the rest is built.
#   cmake -D NPM= -D NODE= -D SOURCE= -D BUILD= -D OUTPUT= -D STAMP= -P build_page.cmake

include("${CMAKE_CURRENT_LIST_DIR}/../../../core/cmake/NpmPackages.cmake")

function(write_source text)
  file(WRITE "${OUTPUT}.new" "// Made by build_page.cmake.\n${text}")
  file(COPY_FILE "${OUTPUT}.new" "${OUTPUT}" ONLY_IF_DIFFERENT)
  file(REMOVE "${OUTPUT}.new")
endfunction()

function(give_up reason)
  message("The inspector has no page: ${reason}\nAll else is built; the next build tries again.")
  file(COPY_FILE "${SOURCE}/missing_page.cpp" "${OUTPUT}" ONLY_IF_DIFFERENT)
endfunction()

install_npm_packages("${NPM}" "${SOURCE}" "${BUILD}" problem)
if(problem)
  give_up("${problem}")
  return()
endif()

execute_process(COMMAND "${NODE}" "${SOURCE}/bundle.mjs" "${BUILD}/page" "${BUILD}/node_modules"
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The page of the inspector could not be bundled.")
endif()

set(entries "")
set(arrays "")
macro(embed file path type)
  file(READ "${BUILD}/page/${file}" bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "k_${file}" name)
  string(APPEND arrays "
static constexpr unsigned char ${name}[] = {
${bytes}};
")
  string(APPEND entries "
      {\"${path}\", \"${type}\", {reinterpret_cast<const char*>(${name}), sizeof(${name})}},")
endmacro()

embed(index.html "/" "text/html; charset=utf-8")
embed(page.js "/page.js" "text/javascript; charset=utf-8")
embed(world_3d.js "/world_3d.js" "text/javascript; charset=utf-8")
embed(page.css "/page.css" "text/css; charset=utf-8")
embed(panel.html "/panel" "text/html; charset=utf-8")
embed(panel.js "/panel.js" "text/javascript; charset=utf-8")
embed(panel.css "/panel.css" "text/css; charset=utf-8")
embed(icon.svg "/icon.svg" "image/svg+xml")
embed(licences.txt "/licences.txt" "text/plain; charset=utf-8")
write_source("#include \"plugins/inspector/page/inspector_page.h\"

namespace runnel {
${arrays}
const std::vector<WebResource>& InspectorPage() {
  static const std::vector<WebResource> files = {${entries}};
  return files;
}

}  // namespace runnel
")
file(TOUCH "${STAMP}")
