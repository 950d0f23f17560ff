# Run by cpack before it packs: makes of the installed trees what Debian expects of its packages.

# compress(<file>): with nothing in it of when and where.
function(compress file)
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changelog "runnel (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What has changed: CHANGELOG.md.gz in /usr/share/doc/runnel.

 -- ${CPACK_RUNNEL_MAINTAINER}  ${date}
")
set(copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/

Files: *
Copyright: 2024-2026 the authors of Runnel
License: Apache-2.0
 On Debian systems the license is in /usr/share/common-licenses/Apache-2.0.
")

foreach(package IN LISTS CPACK_COMPONENTS_ALL)
  set(root "${CPACK_TEMPORARY_DIRECTORY}/${package}/usr")
  set(documents "${root}/share/doc/${package}")
  file(WRITE "${documents}/changelog" "${changelog}")
  compress("${documents}/changelog")
  file(WRITE "${documents}/copyright" "${copyright}")
  # Where everything lies where the loader looks, nothing need say where its libraries are.
  file(GLOB_RECURSE files "${root}/bin/*" "${root}/${CPACK_RUNNEL_LIBRARIES}/*.so*")
  foreach(file IN LISTS files)
    if(NOT IS_SYMLINK "${file}")
      file(RPATH_REMOVE FILE "${file}")
    endif()
  endforeach()
  set(shlibs "")
  file(GLOB libraries RELATIVE "${root}/${CPACK_RUNNEL_LIBRARIES}" "${root}/${CPACK_RUNNEL_LIBRARIES}/*.so.*.*.*")
  foreach(library IN LISTS libraries)
    string(REGEX REPLACE "^(.*)\\.so\\.([0-9]+\\.[0-9]+)\\..*$" "\\1 \\2" name_and_version "${library}")
    string(APPEND shlibs "${name_and_version} ${package} (>= ${CPACK_PACKAGE_VERSION})\n")
  endforeach()
  file(WRITE "${CPACK_RUNNEL_CONTROL}/${package}/shlibs" "${shlibs}")
  file(GLOB manuals "${root}/share/man/man1/*.1")
  foreach(manual IN LISTS manuals)
    compress("${manual}")
  endforeach()
endforeach()

set(documents "${CPACK_TEMPORARY_DIRECTORY}/runnel/usr/share/doc/runnel")
file(REMOVE "${documents}/LICENSE")
compress("${documents}/CHANGELOG.md")

# What the page brings along belongs to others.
if(EXISTS "${CPACK_RUNNEL_PAGE_LICENSES}")
  set(documents "${CPACK_TEMPORARY_DIRECTORY}/runnel-inspector/usr/share/doc/runnel-inspector")
  file(COPY "${CPACK_RUNNEL_PAGE_LICENSES}" DESTINATION "${documents}")
  file(APPEND "${documents}/copyright" "
Files: the page
Copyright: see licences.txt in this folder
License: Expat and others
 The licenses of the libraries that the page contains are in licences.txt in this folder.
")
endif()
