# For scripts that run while building (cmake -P).

# install_npm_packages(<npm> <from> <to> <problem>)
# The packages of <from>/package-lock.json into <to>/node_modules, if they are not there already. Sets
# <problem> to "", or to what npm has said (no network, for example); there is no node_modules then.
function(install_npm_packages npm from to problem)
  set(${problem} "" PARENT_SCOPE)
  file(MAKE_DIRECTORY "${to}")
  file(READ "${from}/package-lock.json" wanted)
  set(installed "")
  if(EXISTS "${to}/installed.json")
    file(READ "${to}/installed.json" installed)
  endif()
  foreach(file package.json package-lock.json)
    file(COPY_FILE "${from}/${file}" "${to}/${file}")
  endforeach()
  if(installed STREQUAL wanted)
    return()
  endif()
  execute_process(
    COMMAND "${npm}" ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-retry-mintimeout=2000 --loglevel=error
    WORKING_DIRECTORY "${to}" RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    file(REMOVE_RECURSE "${to}/node_modules" "${to}/installed.json")
    string(REGEX MATCH "^[^\n]*\n[^\n]*\n[^\n]*\n[^\n]*" said "${said}")
    set(${problem} "npm could not get its packages (is there a network?):\n${said}" PARENT_SCOPE)
    return()
  endif()
  file(WRITE "${to}/installed.json" "${wanted}")
endfunction()
