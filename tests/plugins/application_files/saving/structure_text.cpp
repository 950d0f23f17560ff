#include <algorithm>
#include <vector>

#include "core/module/group.h"
#include "core/plugin/module_type_name.h"
#include "core/port/proxy_port.h"
#include "core/types/type_info.h"
#include "plugins/scheduling/thread_container.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {

namespace {

std::string ThreadOf(const FrameworkElement& element, FrameworkElement& application) {
  std::string name;
  application.Visit([&](FrameworkElement& each) {
    if (each.kind() == ElementKind::kThread && each.id() == OwnThreadId(element)) {
      name = each.name();
    }
  });
  return name;
}

}  // namespace

// Written apart from the saver, so that what that one forgets shows.
std::string StructureText(FrameworkElement& application) {
  std::vector<std::string> lines;
  application.Visit([&](FrameworkElement& element) {
    std::string line = element.path() + " kind " + std::to_string(static_cast<int>(element.kind()));
    line += " type " + FindModuleType(element) + " thread " + ThreadOf(element, application);
    if (const auto* configurable = dynamic_cast<const Configurable*>(&element)) {
      line += " value " + configurable->ToText();
    }
    if (const auto* thread = dynamic_cast<const ThreadContainer*>(&element)) {
      const ThreadOptions& options = thread->options();
      line += " period " + std::to_string(options.period.count()) + " activation " +
              std::to_string(static_cast<int>(options.activation)) + " priority " + std::to_string(options.priority) +
              " " + std::to_string(static_cast<int>(options.on_overrun));
    }
    if (const auto* port = dynamic_cast<const Port*>(&element)) {
      line += " " + port->type().name() + " " + std::to_string(static_cast<int>(port->direction())) + " " +
              port->description();
      for (const Connection& each : port->outgoing()) {
        lines.push_back(port->path() + " -> " + each.to->path() + " queue " + std::to_string(each.options.queue) +
                        " on_full " +
                        (each.options.queue > 0  // without a queue it means nothing
                             ? std::to_string(static_cast<int>(each.options.on_full))
                             : "-"));
      }
    }
    lines.push_back(line);
  });
  std::ranges::sort(lines);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void ExpectSame(FrameworkElement& application, const std::filesystem::path& file, unsigned seed) {
  SavingWorkshop second;
  second.Add<Optional>("test/optional");
  FrameworkElement* const again = second.Load(file);
  ASSERT_NE(again, nullptr) << "seed " << seed << '\n' << ReadAll(file);
  ASSERT_EQ(StructureText(*again), StructureText(application)) << "seed " << seed << '\n' << ReadAll(file);
  // And saved again it is the same text.
  ASSERT_EQ(second.Text(*again, file.parent_path()), ReadAll(file)) << "seed " << seed;
}

}  // namespace runnel::testing
