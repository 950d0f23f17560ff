# What the tests by Foxglove's client need, into the build tree. Where npm cannot get it (no network), the test
# says so; everything else is built.
file(MAKE_DIRECTORY "${TO}")
file(GLOB files "${FROM}/*")
file(COPY ${files} DESTINATION "${TO}")
execute_process(COMMAND "${NPM}" ci --no-audit --no-fund --ignore-scripts WORKING_DIRECTORY "${TO}"
  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  file(REMOVE_RECURSE "${TO}/node_modules")
  message("npm could not install Foxglove's client; its test will be skipped:\n${said}")
endif()
file(TOUCH "${TO}/installed")
