#pragma once

#include <fstream>
#include <iostream>
#include <limits>
#include <string>

#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "core/base/number_text.h"

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

/// For Option::transform: whole numbers in decimal. CLI11 alone takes "-1" for the greatest number there is, and "010" for 8.
template <typename Number>
CLI::Validator WholeNumber(const std::string& what) {
  const auto read = [what](std::string& text) -> std::string {
    const auto number = NumberIn<Number>(text);
    if (!number) {
      return what + " is a whole number from " + std::to_string(std::numeric_limits<Number>::min()) + " to " +
             std::to_string(std::numeric_limits<Number>::max()) + ", not '" + text + "'";
    }
    text = std::to_string(*number);
    return "";
  };
  return {read, ""};
}

/// Writes it into a file, or to standard output if that is "". Returns the exit code.
inline int WriteText(const std::string& text, const std::string& file) {
  if (file.empty()) {
    std::cout << text << std::flush;
    if (std::cout) return exit_code::kDone;
    return Fail({.message = "standard output could not be written"}, exit_code::kRunFailed);
  }
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text << std::flush;
  if (stream) return exit_code::kDone;
  return Fail(
      {.message = "cannot be written", .position = {file}, .hint = "is its folder there, and may you write in it?"},
      exit_code::kRunFailed);
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
