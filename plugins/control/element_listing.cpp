#include "plugins/control/element_listing.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "core/base/characters.h"
#include "core/element/attempt.h"
#include "core/element/configurable.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "core/element/tags.h"
#include "core/paths/late_connections.h"
#include "core/plugin/module_type_name.h"
#include "core/port/converted_flow.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/control/application_state.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/services/callable.h"

namespace runnel {

namespace {

constexpr const char* kUnreached = "CANNOT BE REACHED";

constexpr std::size_t kLongestValue = 200;

// Of an ElementKind, in their order.
constexpr std::array<const char*, 8> kKindNames{"runtime", "group",     "module", "ports",
                                                "port",    "parameter", "thread", "element"};

const char* KindName(const FrameworkElement& element) {
  if (const auto* const port = dynamic_cast<const Port*>(&element)) {
    return port->direction() == Port::Direction::kInput ? "input" : "output";
  }
  return kKindNames[static_cast<std::size_t>(element.kind())];
}

std::string Milliseconds(Duration duration) { return fmt::format("{:.3f}", ToSeconds(duration) * 1e3); }

std::string ParameterLine(const Configurable& parameter) {
  const ConfigurableInfo& info = parameter.info();
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  const std::string value = Shortened(ParameterText(parameter), kLongestValue);
  std::string text = parameter.type().name() + " = " + (value.empty() ? "\"\"" : value) + unit;
  if (!info.bounds.empty()) text += ", in " + info.bounds + unit;
  std::string choices;
  for (const EnumeratorInfo& each : parameter.type().enumerators()) {
    choices += (choices.empty() ? ", one of " : " ") + each.name;
  }
  return text + choices + (info.is_static ? ", static" : "");
}

std::string ThreadText(const ThreadContainer& thread, bool is_long) {
  const ThreadOptions& options = thread.options();
  std::string text = ActivationText(options);
  if (options.priority > 0) text += ", priority " + std::to_string(options.priority);
  if (thread.statistics().is_late) text += ", OVERRUNS";
  if (!is_long) return text;
  const CycleStatistics all = thread.statistics();
  return text + ", " + std::to_string(all.cycles) + " cycles, " + std::to_string(all.overruns) + " overruns, period " +
         Milliseconds(all.period_mean) + " ms (" + Milliseconds(all.period_min) + " .. " +
         Milliseconds(all.period_max) + "), jitter " + Milliseconds(all.jitter_mean) + " ms (max " +
         Milliseconds(all.jitter_max) + "), execution " + Milliseconds(all.execution_mean) + " ms (max " +
         Milliseconds(all.execution_max) + ")";
}

// " = 0.5"; "" where values have no text format.
std::string HandValue(const Port& port) {
  if (!port.type().is_transparent()) return {};
  std::string text;
  VisitShown(port, [&](const void* value, ValueTimes) {
    text = " = " + Shortened(ToText(port.type(), value), kLongestValue);
  });
  return text;
}

// The same of a rule, which a person's covers.
std::string RuleValue(const Port& port) {
  const auto set = port.ValueByHand(Port::Setter::kRule);
  return set ? " = " + Shortened(ToText(port.type(), set->value.get()), kLongestValue) : "";
}

std::string ConversionText(const internal::ConvertedFlow& flow) {
  std::string text = "converted";
  if (!flow.conversion().text().empty()) text += ": " + flow.conversion().text();
  if (flow.failures() > 0) text += ", " + std::to_string(flow.failures()) + " lost";
  return text;
}

std::string LimitsText(const Port& port) {
  const InputLimits& limits = port.limits();
  std::string text;
  if (limits.default_value) {
    text += ", default " + ToText(limits.default_value.type(), limits.default_value.get(), {.all = kLongestValue});
  }
  if (!limits.has_bounds()) return text;
  text += ", in " + BoundsText(limits);
  const std::uint64_t outside = port.out_of_bounds();
  if (outside == 0) return text;
  return text + " (" + std::to_string(outside) + " out of bounds, " +
         OutOfBoundsNames()[static_cast<std::size_t>(limits.out_of_bounds)] + ")";
}

// What is to be connected with the port when it is there.
std::string AwaitedText(const Port& port) {
  std::string text;
  for (const LateConnection* each : AwaitedBy(port)) {
    text += ", waits for " + (each->from == port.path() ? each->to : each->SourceText());
  }
  return text;
}

std::string PortText(const Port& port, const ListingOptions& options) {
  std::string text = port.type().name();
  if (!port.unit().empty()) text += " in " + port.unit();
  if (LacksSource(port)) text += ", NOT CONNECTED, though its module requires it";
  if (const auto silent = SilentFor(port, options.began, options.now)) {
    text += fmt::format(", SILENT for {:.3g} s", ToSeconds(*silent));
  }
  if (port.stamps_ahead()) text += ", STAMPED AHEAD";
  if (port.is_driving()) text += port.runtime().robot_stop().in_force() ? ", driving, IN STOP" : ", driving";
  const std::string unreached = options.scheduler != nullptr ? options.scheduler->WhyUnreached(port) : "";
  if (!unreached.empty()) text += ", " + std::string(kUnreached) + ": " + unreached;
  if (port.is_blocked()) text += ", BLOCKED";
  if (port.is_set_by_hand()) text += ", set by hand" + HandValue(port);
  if (port.is_set_by_hand(Port::Setter::kRule)) text += ", set by a rule" + RuleValue(port);
  text += LimitsText(port) + AwaitedText(port);
  if (!options.is_long) return text + (port.is_required() && !LacksSource(port) ? ", required" : "");
  const Publications publications = Publications::Of(port);
  text += ", " + std::to_string(publications.count) + " values";
  if (publications.newest) {
    text += fmt::format(", newest {:.3g} s old", std::max(0.0, ToSeconds(options.now - *publications.newest)));
  }
  if (const auto known = options.rates.find(port.path()); known != options.rates.end()) {
    PublicationRate rate = known->second;
    text += ", " + RateText(rate.Look(publications, options.now)) + " Hz";
  }
  for (const Port* from : port.incoming()) {
    text += ", from " + from->ConnectionTo(port)->SourceText();
  }
  for (const Connection& each : port.outgoing()) {
    const auto words = SplitPath(each.to->path());
    const bool is_beside = words.size() > 1 && !port.runtime().root().Find(each.to->path());
    if (is_beside) {  // who looks on, and is no part of the tree
      text += ", to the " + std::string(words.front());
      continue;
    }
    text += ", to " + each.to->path();
    if (each.options.queue > 0) text += " (queue " + std::to_string(each.options.queue) + ")";
    if (each.options.pull) text += " (pulled)";
    if (each.converted) text += " (" + ConversionText(*each.converted) + ")";
    if (each.options.when_present) text += " (when present)";
    if (each.options.late) text += " (late)";
  }
  return text;
}

// " #safety #hidden"
std::string TagMarks(const FrameworkElement& element) {
  std::string text;
  for (const std::string& tag : TagsOf(element)) text += " #" + tag;
  return text;
}

// ", FAILED: sensor gone"
std::string StateText(FrameworkElement& element, const ListingOptions& options,
                      const std::map<std::string, std::string>& failed) {
  const auto found = failed.find(element.path());
  if (found != failed.end()) return ", FAILED" + (found->second.empty() ? "" : ": " + found->second);
  if (options.scheduler == nullptr || !IsModule(element)) return {};
  for (const StuckModule& each : options.scheduler->StuckModules()) {
    if (each.path == element.path()) return ", STUCK" + fmt::format(" for {:.1f} s", ToSeconds(each.since));
  }
  if (options.scheduler->IsPaused(element)) return ", PAUSED";
  return {};
}

std::string About(const FrameworkElement& element, const ListingOptions& options) {
  if (const auto* const port = dynamic_cast<const Port*>(&element)) return PortText(*port, options);
  if (const auto* const parameter = dynamic_cast<const Configurable*>(&element)) {
    return ParameterLine(*parameter);
  }
  if (const auto* const thread = dynamic_cast<const ThreadContainer*>(&element)) {
    return ThreadText(*thread, options.is_long);
  }
  std::string text = FindModuleType(element);
  const ThreadContainer* const thread = options.is_long ? OwnThread(element) : nullptr;
  if (thread != nullptr) text += (text.empty() ? "" : ", ") + ("run by " + thread->name());
  return text;
}

struct Row {
  std::string name;
  std::string kind;
  std::string about;
};

void AddRows(FrameworkElement& element, std::size_t depth, const ListingOptions& options,
             const std::map<std::string, std::string>& failed, std::vector<Row>& rows) {
  // The groups of ports say nothing that the ports do not say.
  const bool is_shown = element.kind() != ElementKind::kPortGroup || depth == 0;
  if (is_shown) {
    const std::string name = depth == 0 ? element.path() : element.name();
    rows.push_back({std::string(2 * depth, ' ') + name, KindName(element),
                    About(element, options) + StateText(element, options, failed) + TagMarks(element)});
  }
  for (FrameworkElement* child : element.children()) {
    AddRows(*child, is_shown ? depth + 1 : depth, options, failed, rows);
  }
}

}  // namespace

std::string RateText(double hertz) {
  return hertz >= 10'000 ? fmt::format("{:.0f}", hertz) : fmt::format("{:.5g}", hertz);
}

PublicationRates LookAtRates(FrameworkElement& start) {
  PublicationRates rates;
  start.VisitAll<const Port>(
      [&](const Port& port) { rates[port.path()].Look(Publications::Of(port), port.runtime().clock().Now()); });
  return rates;
}

std::string ListElements(FrameworkElement& start, const ListingOptions& options) {
  std::vector<Row> rows;
  const auto failed = options.scheduler != nullptr ? FailedModules(start, *options.scheduler, options.log)
                                                   : std::map<std::string, std::string>();
  if (start.kind() == ElementKind::kRuntime) {
    for (FrameworkElement* child : start.children()) AddRows(*child, 0, options, failed, rows);
  } else {
    AddRows(start, 0, options, failed, rows);
  }
  for (const LateConnection* each : AwaitedBelow(start)) {
    rows.push_back({each->SourceText() + " -> " + each->to, "connection", "waits: " + *each->waits_for});
  }
  std::size_t name_width = 0;
  std::size_t kind_width = 0;
  for (const Row& row : rows) {
    name_width = std::max(name_width, CharacterCount(row.name));
    kind_width = std::max(kind_width, row.kind.size());
  }
  std::string text = StopText(start.runtime());
  const auto is_unreached = [](const Row& row) { return row.about.find(kUnreached) != row.about.npos; };
  const char* const but_for = std::ranges::any_of(rows, is_unreached) ? ", but for what cannot be reached" : "";
  if (!text.empty()) text += std::string(": all that drives has its safe value") + but_for + "\n";
  for (const Row& row : rows) {
    text += row.name + std::string(name_width - CharacterCount(row.name) + 2, ' ') + row.kind;
    if (!row.about.empty()) {
      text += std::string(kind_width - row.kind.size() + 2, ' ') + row.about;
    }
    text += '\n';
  }
  return text;
}

std::string ListPaths(FrameworkElement& start) {
  std::string text;
  start.Visit([&](FrameworkElement& element) {
    if (element.parent() == nullptr) return;
    text += KindName(element) + ("\t" + element.path());
    const auto* const port = dynamic_cast<const Port*>(&element);
    const auto* const parameter = dynamic_cast<const Configurable*>(&element);
    if (port != nullptr) text += (port->is_proxy() ? "\tinterface\t" : "\t\t") + port->type().name();
    auto* const callable = element.FindAnnotation<Callable>();
    if (callable != nullptr && callable->arguments() != nullptr) {
      text += "\t" + ToText(*callable->arguments(), callable->NewCall()->arguments());
    }
    if (parameter != nullptr) {
      const TypeInfo& type = parameter->type();
      text += "\t\t" + type.name() + "\t";
      if (type.name() == "bool") text += "false true";
      for (const EnumeratorInfo& each : type.enumerators()) {
        text += (&each == &type.enumerators().front() ? "" : " ") + each.name;
      }
    }
    text += "\n";
  });
  return text;
}

}  // namespace runnel
