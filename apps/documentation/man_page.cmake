# Writes the manual page of the program PROGRAM into the file PAGE, from what its commands say of themselves: what
# `runnel COMMAND --help` says is said in one place. Run by CMake in script mode.

# What troff would take for its own is taken for text.
function(append_text text)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  string(STRIP "${text}" stripped)
  set(page "${page}.nf\n${stripped}\n.fi\n" PARENT_SCOPE)
endfunction()

function(help_of words text)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env --unset=RUNNEL_PLUGIN_PATH COLUMNS=76 NO_COLOR=1
    "${PROGRAM}" ${words} --help OUTPUT_VARIABLE said RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} ${words} --help ended with ${status}")
  endif()
  set(${text} "${said}" PARENT_SCOPE)
endfunction()

help_of("" overview)
set(page ".TH RUNNEL 1 \"\" \"Runnel ${VERSION}\"\n.SH NAME\nrunnel \\- runs robot applications, looks at them and changes them\n")
string(APPEND page ".SH SYNOPSIS\n.B runnel\nCOMMAND [OPTION ...]\n.SH DESCRIPTION\n")
append_text("${overview}")
string(APPEND page ".SH COMMANDS\n")
string(REGEX MATCHALL "\n  [a-z][a-z_]*  " lines "${overview}")
foreach(line IN LISTS lines)
  string(STRIP "${line}" command)
  help_of("${command}" help)
  string(APPEND page ".SS runnel ${command}\n")
  append_text("${help}")
endforeach()
string(APPEND page ".SH ENVIRONMENT\n.TP\nRUNNEL_PLUGIN_PATH\nfolders, with colons between, in which plugins are looked for before those that are installed\n")
string(APPEND page ".TP\nXDG_RUNTIME_DIR\nthe folder of the sockets by which running applications are reached\n")
string(APPEND page ".SH SEE ALSO\nThe pages in the folder share/doc/runnel of the installation, from pages/index.md on.\n")
file(WRITE "${PAGE}" "${page}")
