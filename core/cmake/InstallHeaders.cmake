# Run by `cmake --install`: copies the public `headers` of the tree at `root` below `folder`/runnel, so that
# "core/port/input.h" is <runnel/core/port/input.h> there, also where they include each other. Those of
# apps/headers/runnel are <runnel/module.h> and so on.
set(destination "${CMAKE_INSTALL_PREFIX}/${folder}/runnel")
message(STATUS "Installing: ${destination}")
foreach(header IN LISTS headers)
  file(READ "${header}" text)
  string(REGEX REPLACE "#include \"((core|plugins|modules)/[^\"]+)\"" "#include <runnel/\\1>" text "${text}")
  string(REPLACE "${root}/" "" name "${header}")
  string(REPLACE "apps/headers/runnel/" "" name "${name}")
  set(installed "${destination}/${name}")
  # One that is the same stays as old as it is: what includes it need not be built again.
  set(before "")
  if(EXISTS "$ENV{DESTDIR}${installed}")
    file(READ "$ENV{DESTDIR}${installed}" before)
  endif()
  if(NOT text STREQUAL before)
    file(WRITE "$ENV{DESTDIR}${installed}" "${text}")
  endif()
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${installed}")
endforeach()
