// What plugins bring, listed and as a schema.

#include <algorithm>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <unistd.h>

#include "apps/runnel/command_line.h"
#include "apps/runnel/output.h"
#include "core/base/characters.h"
#include "core/base/files.h"
#include "plugins/application/application_description.h"
#include "plugins/application/schema.h"
#include "plugins/manifest/module_description.h"
#include "plugins/manifest/plugin_manifest.h"

namespace runnel::program {

namespace {

using Row = std::vector<std::string>;

void WriteTable(const std::string& title, const std::vector<Row>& rows) {
  if (rows.empty()) return;
  std::cout << "  " << title << '\n';
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], CharacterCount(row[i]));
  }
  for (const Row& row : rows) {
    std::string line = "   ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (widths[i] > 0) line += " " + row[i] + std::string(widths[i] - CharacterCount(row[i]) + 1, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << '\n';
  }
}

std::vector<Row> Ports(const ModuleDescription& module, bool are_inputs) {
  std::vector<Row> rows;
  for (const ModuleDescription::Port& port : module.ports) {
    if (port.is_input != are_inputs) continue;
    rows.push_back({port.PathInModule(), port.type, port.is_required ? "required" : "", port.description});
  }
  return rows;
}

std::vector<Row> Parameters(const ModuleDescription& module) {
  std::vector<Row> rows;
  for (const ModuleDescription::Parameter& each : module.parameters) {
    const std::string unit = each.unit.empty() ? "" : " " + each.unit;
    const std::string value = each.default_value.empty() ? "" : "= " + each.default_value + unit;
    const std::string choices = fmt::format("{}", fmt::join(each.choices, ", "));
    rows.push_back({each.name, each.type, value, each.bounds.empty() ? choices : "in " + each.bounds + unit,
                    each.is_static ? "static" : "", each.description});
  }
  return rows;
}

void WriteModule(const ModuleDescription& module) {
  std::cout << module.type << (module.summary.empty() ? "" : "  " + module.summary) << '\n';
  WriteTable("inputs", Ports(module, true));
  WriteTable("outputs", Ports(module, false));
  WriteTable("parameters", Parameters(module));
  std::cout << '\n';
}

// What the plugins have, or all that can be found if none is named: by their manifests, and by loading those that
// have none. Says which could not be looked at, and why; then `all_are_there` is false.
std::vector<ModuleDescription> DescribeModules(const std::vector<std::string>& chosen, bool& all_are_there) {
  ApplicationDescription surroundings;
  PluginManager& plugins = surroundings.plugins();
  std::vector<ModuleDescription> modules;
  for (const std::string& plugin : chosen.empty() ? plugins.Available() : chosen) {
    const auto file = plugins.FindFile(plugin);
    auto manifest = file ? ReadManifest(*file) : file.error();
    if (manifest) {
      std::ranges::move(manifest->modules, std::back_inserter(modules));
    } else if (const auto loaded = plugins.Load(plugin); !loaded) {
      PrintError(loaded.error());
      all_are_there = false;
    }
  }
  for (const ModuleType* type : plugins.modules().All()) {
    auto module = DescribeByMaking(surroundings.runtime(), plugins.modules(), type->name);
    if (module) modules.push_back(std::move(*module));
  }
  std::ranges::sort(modules, {}, &ModuleDescription::type);
  return modules;
}

// How many errors it has.
std::size_t CheckOne(const std::string& file, const ApplicationArguments& arguments, const std::string& model_file) {
  ApplicationDescription description(arguments.Options());
  (void)description.Read(file);
  description.RunChecks(model_file);
  std::cerr << Coloured(description.diagnostics().ToString(), STDERR_FILENO);
  const std::size_t errors = description.diagnostics().errors().size();
  if (errors == 0) std::cout << file << ": no errors\n" << std::flush;
  return errors;
}

// "a.xml b.xml goal_x=4": further files stand among the settings.
bool IsFile(const std::string& word) { return word.find('=') == std::string::npos; }

}  // namespace

ExitCode ListModules(const ModulesArguments& arguments) {
  bool all_are_there = true;
  const auto modules = DescribeModules(arguments.plugins, all_are_there);
  if (arguments.as_json) std::cout << JsonText(modules) << '\n';
  for (const ModuleDescription& module : modules) {
    if (arguments.as_json) continue;
    if (arguments.names_only) {
      std::cout << module.type << '\n';
    } else if (module.problem.empty()) {
      WriteModule(module);
    } else {
      std::cerr << module.problem << '\n';
      all_are_there = false;
    }
  }
  return all_are_there ? ExitCode::kDone : ExitCode::kBadInput;
}

ExitCode WriteSchema(const SchemaArguments& arguments) {
  ApplicationDescription surroundings;
  PluginManager& plugins = surroundings.plugins();
  Diagnostics diagnostics;
  for (const std::string& plugin : arguments.plugins.empty() ? plugins.Available() : arguments.plugins) {
    if (auto loaded = plugins.Load(plugin); !loaded) diagnostics.Add(loaded.error());
  }
  const std::string text = SchemaText(surroundings.tags(), plugins.modules(), diagnostics);
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return ExitCode::kBadInput;
  if (arguments.output.empty()) {
    std::cout << text;
    return ExitCode::kDone;
  }
  const auto written = ReplaceFile(arguments.output, text);
  return written ? ExitCode::kDone : Fail(written.error());
}

ExitCode Check(const CheckArguments& check) {
  const ApplicationArguments& arguments = check.application;
  ApplicationArguments common = arguments;
  std::erase_if(common.settings, IsFile);
  std::size_t errors = CheckOne(arguments.file, common, check.model_file);
  for (const std::string& word : arguments.settings) {
    if (IsFile(word)) errors += CheckOne(word, common, {});
  }
  if (errors == 0) return ExitCode::kDone;
  std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
  return ExitCode::kBadInput;
}

}  // namespace runnel::program
