#pragma once

namespace runnel::program {

/// Lets what is written to a pipe that nobody reads any more be lost ("| head -1"), rather than end
/// the program: a run shall end in order.
void OutliveReaders();

/// Writes what is still in stdout's buffer. False if not all output could be written, though there
/// is somebody to read it: a full disk.
[[nodiscard]] bool FinishOutput();

}  // namespace runnel::program
