#pragma once

#include "core/base/error.h"

namespace runnel::program {

/// Writes it to stderr, in one line: "app.xml:3:5: error: /demo/x: …".
void PrintError(const Error& error);

}  // namespace runnel::program
