#pragma once

#include <iostream>

#include <CLI/CLI.hpp>

#include "core/base/diagnostics.h"
#include "core/base/exception_text.h"

// What the programs beside `runnel` have in common.
namespace runnel {

/// As those of `runnel`.
namespace exit_code {
constexpr int kDone = 0, kRunFailed = 1, kBadInput = 2;
}

/// Says on stderr what is wrong. Returns `code`.
inline int Fail(const Error& error, int code = exit_code::kBadInput) {
  Diagnostics diagnostics;
  diagnostics.Add(error);
  std::cerr << diagnostics.ToString();
  return code;
}

/// Reads the command line into what the options of `program` refer to, and does `work`, which returns the exit code.
template <typename Work>
int RunProgram(CLI::App& program, int count, const char* const* words, Work&& work) {
  try {
    program.parse(count, words);
    return work();
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::Error& error) {
    std::cerr << "error: " << error.what() << "; see '" << program.get_name() << " --help'\n";
    return exit_code::kBadInput;
  } catch (...) {  // plugins may throw anything
    std::cerr << "error: " << DescribeException() << '\n';
    return exit_code::kRunFailed;
  }
}

}  // namespace runnel
