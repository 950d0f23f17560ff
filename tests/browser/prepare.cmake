# Run while building: the tests' packages by `npm ci`, and the tests themselves, beside each other in
# BUILD. Without a network nothing is lost but these tests, which are then skipped.
#   cmake -D NPM= -D NODE= -D SOURCE= -D BUILD= -D PAGE= -D STAMP= -P prepare.cmake

include("${CMAKE_CURRENT_LIST_DIR}/../../core/cmake/NpmPackages.cmake")

install_npm_packages("${NPM}" "${SOURCE}" "${BUILD}" problem)
if(problem)
  message("The browser tests will be skipped: ${problem}")
  return()
endif()

file(REMOVE_RECURSE "${BUILD}/browser" "${BUILD}/long" "${BUILD}/mock" "${BUILD}/support" "${BUILD}/unit")
foreach(folder browser long mock support)
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
