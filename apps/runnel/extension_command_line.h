#pragma once

#include <deque>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "plugins/application/application_options.h"
#include "plugins/application/extension_description.h"

namespace runnel::program {

/// The options that extensions add to a command which runs an application.
class ExtensionCommandLine {
 public:
  /// Adds them to `command`, which must not outlive this.
  ExtensionCommandLine(const ExtensionCatalogue& catalogue, CLI::App& command);

  /// After parsing: the extensions of which an option has been given.
  [[nodiscard]] std::vector<ExtensionByName> Chosen() const;
  /// After parsing: the libraries that the given options need from the start of the process.
  [[nodiscard]] std::vector<std::string> Preloads() const;

 private:
  struct Entry {
    std::string extension;
    ExtensionOption option;
    CLI::Option* parsed = nullptr;
    std::string value = {};
    std::vector<std::string> values = {};  // of a list
  };
  void Add(CLI::App& command, Entry& entry, const std::string& group);

  std::deque<Entry> entries_;  // whose addresses the parser keeps
};

}  // namespace runnel::program
