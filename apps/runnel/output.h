#pragma once

#include <string>
#include <string_view>

#include "apps/runnel/command_line.h"
#include "core/element/framework_element.h"

namespace runnel::program {

/// Writes it to stderr, in one line: "app.xml:3:5: error: /demo/x: …".
void PrintError(const Error& error);
/// The same, and returns `code`.
ExitCode Fail(const Error& error, ExitCode code = ExitCode::kRunFailed);

/// The text, of which others may have written parts, as Printable(), with what matters in colours ("error:" in red), if a terminal shows it and NO_COLOR is not set.
[[nodiscard]] std::string Coloured(std::string_view text, int descriptor);

/// Lets what is written to a pipe that nobody reads any more be lost ("| head -1"), rather than end
/// the program: a run shall end in order.
void OutliveReaders();

/// Writes what is still in stdout's buffer. False if not all output could be written, though there
/// is somebody to read it: a full disk.
[[nodiscard]] bool FinishOutput();

/// How the cycles of all threads at and below `root` have gone, one line each under a heading.
[[nodiscard]] std::string StatisticsTable(FrameworkElement& root);

}  // namespace runnel::program
