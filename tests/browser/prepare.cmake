# Run while building: the tests' packages by `npm ci`, and the tests themselves, beside each other in
# BUILD. Without a network nothing is lost but these tests, which are then skipped.
#   cmake -D NPM= -D NODE= -D SOURCE= -D BUILD= -D PAGE= -D STAMP= -P prepare.cmake

file(READ "${SOURCE}/package-lock.json" wanted)
set(installed "")
if(EXISTS "${BUILD}/installed.json")
  file(READ "${BUILD}/installed.json" installed)
endif()
foreach(file package.json package-lock.json)
  file(COPY_FILE "${SOURCE}/${file}" "${BUILD}/${file}")
endforeach()
if(NOT installed STREQUAL wanted)
  execute_process(
    COMMAND "${NPM}" ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-retry-mintimeout=2000 --loglevel=error
    WORKING_DIRECTORY "${BUILD}" RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    string(REGEX MATCH "^[^\n]*\n[^\n]*\n[^\n]*\n[^\n]*" said "${said}")
    message("The browser tests will be skipped: npm could not get their packages:\n${said}")
    return()
  endif()
  file(WRITE "${BUILD}/installed.json" "${wanted}")
endif()

file(REMOVE_RECURSE "${BUILD}/browser" "${BUILD}/mock" "${BUILD}/support" "${BUILD}/unit")
foreach(folder browser mock support)
  file(COPY "${SOURCE}/${folder}" DESTINATION "${BUILD}")
endforeach()
if(NOT EXISTS "${PAGE}/node_modules/esbuild")
  return()  # there was no network when the page was to be built, which has said so
endif()
execute_process(
  COMMAND "${NODE}" "${SOURCE}/bundle_units.mjs" "${BUILD}/unit" "${PAGE}/node_modules"
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The tests of the page's logic could not be bundled.")
endif()
file(TOUCH "${STAMP}")
