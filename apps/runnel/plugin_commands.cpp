// What plugins bring, listed and as a schema.

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "apps/runnel/commands.h"
#include "apps/runnel/output.h"
#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/base/replace_file.h"
#include "core/element/configurable.h"
#include "core/port/path_search.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/application/application_description.h"
#include "plugins/application_files/schema.h"

namespace runnel::program {

namespace {

using Row = std::vector<std::string>;

void WriteTable(const std::string& title, const std::vector<Row>& rows) {
  if (rows.empty()) return;
  std::cout << "  " << title << '\n';
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], CharacterCount(row[i]));
  }
  for (const Row& row : rows) {
    std::string line = "   ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (widths[i] > 0)
        line += " " + row[i] + std::string(widths[i] - CharacterCount(row[i]) + 1, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << '\n';
  }
}

// Modules with other groups than "input" and "output" need the group's name in paths now and then.
std::string NameOf(const Port& port) {
  const std::string& group = port.parent()->name();
  return group == "input" || group == "output" ? port.name() : group + "/" + port.name();
}

std::vector<Row> Ports(FrameworkElement& module, Port::Direction direction) {
  std::vector<Row> rows;
  for (const Port* port : PortsOf(module)) {
    if (port->direction() != direction) continue;
    rows.push_back({NameOf(*port), port->type().name(), port->is_required() ? "required" : "",
                    port->description()});
  }
  return rows;
}

// Of an enumeration: "left, right".
std::string Choices(const TypeInfo& type) {
  return fmt::format("{}", fmt::join(NamesOf(type.enumerators(), &EnumeratorInfo::name), ", "));
}

std::vector<Row> Parameters(const FrameworkElement& module) {
  std::vector<Row> rows;
  for (const auto& [element, configurable] : ConfigurablesOf(module)) {
    const ConfigurableInfo& info = configurable->info();
    const std::string unit = info.unit.empty() ? "" : " " + info.unit;
    const std::string value = info.default_value.empty() ? "" : "= " + info.default_value + unit;
    const std::string bounds = info.bounds.empty() ? "" : "in " + info.bounds + unit;
    const std::string choices = Choices(configurable->type());
    rows.push_back({element->name(), configurable->type().name(), value,
                    bounds.empty() ? choices : bounds, info.is_static ? "static" : "",
                    info.description});
  }
  return rows;
}

// Makes a module of the type, writes down its ports and parameters, and deletes it again. Errors: it cannot be
// made.
Result<void> ListModule(const ModuleType& type, ApplicationDescription& surroundings) {
  Runtime& runtime = surroundings.runtime();
  const auto module = surroundings.plugins().modules().CreateSample(type.name, runtime.root());
  if (!module) return module.error();
  std::cout << type.name << (type.summary.empty() ? "" : "  " + type.summary) << '\n';
  WriteTable("inputs", Ports(**module, Port::Direction::kInput));
  WriteTable("outputs", Ports(**module, Port::Direction::kOutput));
  WriteTable("parameters", Parameters(**module));
  std::cout << '\n';
  return runtime.Delete(**module);
}

// Loads the plugins, or all that can be found if none is named. False after saying which could not
// be loaded, and why; the others have been.
bool LoadChosenPlugins(const std::vector<std::string>& chosen,
                       ApplicationDescription& surroundings) {
  bool all_are_there = true;
  for (const std::string& plugin : chosen.empty() ? surroundings.plugins().Available() : chosen) {
    const auto loaded = surroundings.plugins().Load(plugin);
    if (loaded) continue;
    PrintError(loaded.error());
    all_are_there = false;
  }
  return all_are_there;
}

}  // namespace

ExitCode ListModules(const ModulesArguments& arguments) {
  ApplicationDescription surroundings;
  ExitCode code =
      LoadChosenPlugins(arguments.plugins, surroundings) ? ExitCode::kDone : ExitCode::kBadInput;
  for (const ModuleType* type : surroundings.plugins().modules().All()) {
    if (arguments.names_only) {
      std::cout << type->name << '\n';
    } else if (auto listed = ListModule(*type, surroundings); !listed) {
      PrintError(listed.error());
      code = ExitCode::kBadInput;
    }
  }
  return code;
}

ExitCode WriteSchema(const SchemaArguments& arguments) {
  ApplicationDescription surroundings;
  if (!LoadChosenPlugins(arguments.plugins, surroundings)) return ExitCode::kBadInput;
  Diagnostics diagnostics;
  const std::string text =
      SchemaText(surroundings.tags(), surroundings.plugins().modules(), diagnostics);
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return ExitCode::kBadInput;
  if (arguments.output.empty()) {
    std::cout << text;
    return ExitCode::kDone;
  }
  const auto written = ReplaceFile(arguments.output, text);
  if (written) return ExitCode::kDone;
  PrintError(written.error());
  return ExitCode::kRunFailed;
}

}  // namespace runnel::program
