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
  ExtensionCommandLine(const ExtensionCatalogue& catalogue, CLI::App& command) {
    for (const ExtensionDescription& extension : catalogue.all()) {
      const std::string group = extension.name + ", which " + extension.summary;
      for (const ExtensionOption& option : extension.options) {
        if (!option.command.empty() && option.command != command.get_name()) continue;
        Add(command, entries_.emplace_back(Entry{extension.name, option}), group);
      }
    }
  }

  /// After parsing: the extensions of which an option has been given.
  [[nodiscard]] std::vector<ExtensionByName> Chosen() const {
    std::vector<ExtensionByName> chosen;
    for (const Entry& entry : entries_) {
      if (entry.parsed->empty()) continue;
      if (chosen.empty() || chosen.back().name != entry.extension) {
        chosen.push_back({entry.extension});
      }
      auto& values = chosen.back().arguments.values;
      const bool is_left_out = entry.option.kind == Kind::kOptionalValue && entry.value == "true";
      if (entry.option.kind != Kind::kList) {
        values.emplace_back(entry.option.name, is_left_out ? "" : entry.value);
      }
      for (const std::string& each : entry.values) values.emplace_back(entry.option.name, each);
    }
    return chosen;
  }
  /// After parsing: the libraries that the given options need from the start of the process.
  [[nodiscard]] std::vector<std::string> Preloads() const {
    std::vector<std::string> libraries;
    for (const Entry& entry : entries_) {
      if (!entry.parsed->empty() && !entry.option.preload.empty()) {
        libraries.push_back(entry.option.preload);
      }
    }
    return libraries;
  }

 private:
  using Kind = ExtensionOption::Kind;
  struct Entry {
    std::string extension;
    ExtensionOption option;
    CLI::Option* parsed = nullptr;
    std::string value = {};
    std::vector<std::string> values = {};  // of a list
  };
  void Add(CLI::App& command, Entry& entry, const std::string& group) {
    const ExtensionOption& option = entry.option;
    const std::string name = "--" + option.name;
    switch (option.kind) {
      case Kind::kFlag:
        entry.parsed = command.add_flag(name, option.summary);
        break;
      case Kind::kOptionalValue:  // a flag, so that the word after it is not taken for its value
        entry.parsed = command.add_flag(name, entry.value, option.summary);
        break;
      case Kind::kValue:
        entry.parsed = command.add_option(name, entry.value, option.summary);
        break;
      case Kind::kList:
        entry.parsed = command.add_option(name, entry.values, option.summary);
        entry.parsed->allow_extra_args(false);
        break;
      case Kind::kArgument:
        entry.parsed = command.add_option(option.name, entry.value, option.summary)->required();
        break;
    }
    const bool has_value = option.kind != Kind::kFlag && option.kind != Kind::kOptionalValue;
    if (has_value) entry.parsed->type_name(option.value_name);
    if (option.kind != Kind::kArgument) entry.parsed->group(group);
  }

  std::deque<Entry> entries_;  // whose addresses the parser keeps
};

}  // namespace runnel::program
