#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Builds the application and runs it until its monitors have come to a verdict, its time is up, a
/// fault stops it, or the user does. Progress and verdict go to stdout, all that is wrong to
/// stderr.
[[nodiscard]] ExitCode Run(const RunArguments& arguments);

/// Builds the application, runs nothing, and says what is wrong with it.
[[nodiscard]] ExitCode Check(const CheckArguments& arguments);

/// Draws the data flow of an application that is built and not run. SVG, PNG and PDF need the
/// program `dot` of Graphviz.
[[nodiscard]] ExitCode DrawGraph(const GraphArguments& arguments);

/// Lists the module types of plugins on stdout.
[[nodiscard]] ExitCode ListModules(const ModulesArguments& arguments);

/// Writes the XML schema of application files with the words and types of the plugins.
[[nodiscard]] ExitCode WriteSchema(const SchemaArguments& arguments);

/// Asks a running application and shows the answer: on stdout what was asked for, on stderr what is wrong.
[[nodiscard]] ExitCode Control(const ControlArguments& arguments);

/// The STOP of the robot, in each running application, or in the one that is named; says what has become of it in each.
[[nodiscard]] ExitCode Stop(const ControlArguments& arguments);

/// Writes what could stand in place of the last of the words, one a line: paths, types and threads of a
/// running application. For the completion of shells, so it says nothing where it knows nothing.
[[nodiscard]] ExitCode Complete(const ControlArguments& arguments);

}  // namespace runnel::program
