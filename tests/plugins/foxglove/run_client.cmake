# Runs the test by Foxglove's client, or says why not (the word "skipped:" is what CTest looks for).
if(NOT EXISTS "${CLIENT}/node_modules/@foxglove/ws-protocol")
  message("skipped: npm could not install Foxglove's client (no network while building?)")
  return()
endif()
execute_process(COMMAND "${NODE}" --test "${CLIENT}/foxglove.test.mjs" WORKING_DIRECTORY "${CLIENT}"
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the test by Foxglove's client has failed")
endif()
