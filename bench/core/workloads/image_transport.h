#pragma once

#include <string>

namespace runnel::bench {

/// What one process of the image transport does.
struct ImageTransport {
  std::string subject;
  int readers = 0;
  double seconds = 2.0;
};

/// Runs it in this process, which must be a fresh one, and prints CPU %, peak RSS in MB, and the
/// share of the images that came to readers (1 without readers). Returns the exit code.
int RunImageTransport(const ImageTransport& transport);

}  // namespace runnel::bench
