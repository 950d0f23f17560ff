#include "apps/runnel/module_listing.h"

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "core/base/characters.h"
#include "core/element/configurable.h"
#include "core/port/path_search.h"
#include "core/port/port.h"
#include "core/types/type_info.h"

namespace runnel::program {

namespace {

using Row = std::vector<std::string>;

void WriteTable(const std::string& title, const std::vector<Row>& rows, std::ostream& stream) {
  if (rows.empty()) return;
  stream << "  " << title << '\n';
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
    stream << line << '\n';
  }
}

// Modules with other groups than "input" and "output" need the group's name in paths now and then.
std::string NameOf(const Port& port) {
  const std::string& group = port.parent()->name();
  return group == "input" || group == "output" ? port.name() : group + "/" + port.name();
}

std::vector<Row> Ports(FrameworkElement& module, Port::Direction direction) {
  std::vector<Row> rows;
  module.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || port->direction() != direction) return;
    rows.push_back({NameOf(*port), port->type().name(), port->is_required() ? "required" : "",
                    port->description()});
  });
  return rows;
}

// Of an enumeration: "left, right".
std::string Choices(const TypeInfo& type) {
  std::string names;
  for (const EnumeratorInfo& each : type.enumerators()) {
    names += (names.empty() ? "" : ", ") + each.name;
  }
  return names;
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

}  // namespace

Result<void> ListModule(const ModuleType& type, ApplicationDescription& surroundings,
                        std::ostream& stream) {
  Runtime& runtime = surroundings.runtime();
  const auto module = surroundings.plugins().modules().Create(type.name, runtime.root(), "module");
  if (!module) return module.error();
  stream << type.name << (type.summary.empty() ? "" : "  " + type.summary) << '\n';
  WriteTable("inputs", Ports(**module, Port::Direction::kInput), stream);
  WriteTable("outputs", Ports(**module, Port::Direction::kOutput), stream);
  WriteTable("parameters", Parameters(**module), stream);
  stream << '\n';
  return runtime.Delete(**module);
}

}  // namespace runnel::program
