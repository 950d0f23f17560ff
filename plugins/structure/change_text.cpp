#include "plugins/structure/change_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/types/duration_text.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_arguments.h"

namespace runnel {

namespace {

using internal::Arguments;
using internal::ChangeArgument;
using internal::ChangeLine;

constexpr std::size_t kLongestQueue = 1'000'000;
constexpr std::uint64_t kLongestProbation = 1'000'000'000;
const std::vector<std::string> kNoOrYes{"false", "true"};
const std::vector<std::string> kDirections{"input", "output"};

// period=20ms priority=10 on_overrun=skip activation=trigger
template <typename Thread>
void ReadThreadOptions(Arguments& arguments, Thread& thread) {
  const auto read = [&](const ChangeArgument& argument) {
    if (argument.name() == "period") {
      const auto period = ParseDuration(argument.value());
      if (!period) arguments.Complain(argument.position, period.error().message, period.error().hint);
      if (period) thread.period = *period;
    } else if (argument.name() == "priority") {
      thread.priority = arguments.ReadCount<int>(argument, 99);
    } else if (argument.name() == "on_overrun") {
      thread.on_overrun =
          static_cast<ThreadOptions::OnOverrun>(arguments.Choose(argument, argument.value(), OverrunNames()));
    } else if (argument.name() == "activation") {
      thread.activation =
          static_cast<ThreadOptions::Activation>(arguments.Choose(argument, argument.value(), ActivationNames()));
    } else {
      return false;
    }
    return true;
  };
  arguments.TakeOptions({"period", "priority", "on_overrun", "activation"}, read);
}

std::string TakeDescription(Arguments& arguments) {
  std::string description;
  arguments.TakeOptions({"description"}, [&](const ChangeArgument& argument) {
    if (argument.name() == "description") description = argument.value();
    return argument.name() == "description";
  });
  return description;
}

std::vector<Setting> TakeSettings(Arguments& arguments) {
  std::vector<Setting> settings;
  arguments.TakeOptions({}, [&](const ChangeArgument& argument) {
    settings.push_back({argument.name(), argument.value()});
    return true;
  });
  return settings;
}

Change ReadCreate(Arguments& arguments) {
  if (arguments.TakeIf("group")) {
    return CreateGroup{arguments.Take("a path")};
  }
  if (arguments.TakeIf("thread")) {
    AddThread change{.name = arguments.Take("a name")};
    ReadThreadOptions(arguments, change.options);
    return change;
  }
  if (arguments.TakeIf("port")) {
    CreatePort change{.path = arguments.Take("a path"), .type = {}};
    change.direction = arguments.TakeOneOf("'input' or 'output'", kDirections) == 0 ? Port::Direction::kInput
                                                                                    : Port::Direction::kOutput;
    change.type = arguments.Take("a data type");
    change.description = TakeDescription(arguments);
    return change;
  }
  if (arguments.TakeIf("parameter")) {
    CreateParameter change{arguments.Take("a path"), {}};
    change.targets = arguments.TakeWords("a parameter that it stands for");
    change.description = TakeDescription(arguments);
    return change;
  }
  CreateModule change{arguments.Take("a path"), arguments.Take("a module type")};
  change.settings = TakeSettings(arguments);
  return change;
}

Change ReadConnect(Arguments& arguments) {
  ConnectPorts change{arguments.Take("the output"), arguments.Take("the input")};
  const ChangeArgument* on_full = nullptr;
  const ChangeArgument* pull = nullptr;
  arguments.TakeOptions({"queue", "on_full", "pull", "convert", "when", "late"}, [&](const ChangeArgument& argument) {
    if (argument.name() == "queue") {
      change.options.queue = arguments.ReadCount<std::size_t>(argument, kLongestQueue);
    } else if (argument.name() == "on_full") {
      on_full = &argument;
      change.options.on_full = static_cast<OnFull>(arguments.Choose(argument, argument.value(), OnFullNames()));
    } else if (argument.name() == "pull") {
      pull = &argument;
      change.options.pull = arguments.Choose(argument, argument.value(), kNoOrYes) == 1;
    } else if (argument.name() == "late") {
      change.options.late = arguments.Choose(argument, argument.value(), kNoOrYes) == 1;
    } else if (argument.name() == "when") {
      (void)arguments.Choose(argument, argument.value(), {"present"});
      change.options.when_present = true;
    } else if (argument.name() == "convert") {
      change.options.convert = argument.value();
    } else {
      return false;
    }
    return true;
  });
  if (on_full != nullptr && change.options.queue == 0) {
    arguments.Complain(on_full->position, "on_full has no meaning without a queue",
                       "add queue=N with a count above 0, or leave out on_full");
  }
  if (change.options.pull && change.options.queue > 0) {
    arguments.Complain(pull->position, "a connection that pulls cannot have a queue",
                       "what is pulled is the newest value; leave out one of the two");
  }
  return change;
}

Change ReadReplace(Arguments& arguments) {
  ReplaceModule change{arguments.Take("the path of a module"), {}};
  arguments.Expect("with");
  change.type = arguments.Take("a module type");
  arguments.TakeOptions({}, [&](const ChangeArgument& argument) {
    if (argument.name() == "probation") {
      change.probation_cycles = arguments.ReadCount<std::uint64_t>(argument, kLongestProbation);
    } else {
      change.settings.push_back({argument.name(), argument.value()});
    }
    return true;
  });
  return change;
}

Change ReadCopy(Arguments& arguments) {
  CopyElement change{arguments.Take("a path")};
  if (!arguments.IsAtEnd()) change.name = arguments.Take("a name");
  return change;
}

Change ReadMove(Arguments& arguments) {
  AssignToThread change{arguments.Take("a path"), {}};
  arguments.Expect("to");
  change.thread = arguments.Take("a thread");
  return change;
}

Change ReadTag(Arguments& arguments) {
  TagElement change{arguments.Take("a path"), {}};
  if (!arguments.IsAtEnd()) change.tags = arguments.TakeWords("a tag");
  return change;
}

Change ReadLog(Arguments& arguments) {
  std::vector<std::string> levels(LogLevelNames().begin(), LogLevelNames().end());
  levels.emplace_back("inherit");
  LogElement change{arguments.Take("a path")};
  const std::size_t level = arguments.TakeOneOf("a level", levels);
  if (level + 1 < levels.size()) change.level = static_cast<LogLevel>(level);
  return change;
}

Change ReadSchedule(Arguments& arguments) {
  ScheduleThread change{.thread = arguments.Take("a thread")};
  ReadThreadOptions(arguments, change);
  return change;
}

// What words there are, and what they mean, the extension says.
template <std::size_t kWords>
Change ReadExtension(Arguments& arguments) {
  ExtensionChange change{arguments.verb(), {}};
  while (change.words.size() < kWords) change.words.push_back(arguments.Take("a path"));
  change.settings = TakeSettings(arguments);
  return change;
}

struct Verb {
  const char *name, *usage;
  Change (*read)(Arguments& arguments);
};
constexpr std::array<Verb, 14> kVerbs{{
    {"create",
     "create [group] PATH TYPE [NAME=VALUE ...], or create port PATH input|output TYPE "
     "[description=TEXT], or create parameter PATH PARAMETER ... [description=TEXT], or create thread NAME "
     "[period=TIME] [activation=period|free_running|trigger] [priority=N]",
     ReadCreate},
    {"delete", "delete PATH", [](Arguments& a) -> Change { return DeleteElement{a.Take("a path")}; }},
    {"connect",
     "connect FROM[.PART] TO [queue=N] [on_full=drop_oldest|drop_newest|refuse] [pull=true] "
     "[convert=NAME] [when=present] [late=true]",
     ReadConnect},
    {"disconnect", "disconnect FROM TO",
     [](Arguments& a) -> Change {
       return DisconnectPorts{a.Take("the output"), a.Take("the input")};
     }},
    {"set", "set PATH VALUE, with a VALUE that has blanks in quotation marks",
     [](Arguments& a) -> Change {
       return SetParameter{a.Take("the path of a parameter"), a.Take("a value")};
     }},
    {"replace", "replace PATH with TYPE [NAME=VALUE ...] [probation=CYCLES]", ReadReplace},
    {"rename", "rename PATH NAME",
     [](Arguments& a) -> Change {
       return RenameElement{a.Take("a path"), a.Take("the new name")};
     }},
    {"copy", "copy PATH [NAME]", ReadCopy},
    {"move", "move PATH to THREAD", ReadMove},
    {"tag", "tag PATH [WORD ...]", ReadTag},
    {"log", "log PATH debug|info|warning|error|off|inherit", ReadLog},
    {"offer", "offer PORT [NAME=VALUE ...] [remove=true]", ReadExtension<1>},
    {"take", "take TOPIC PORT [NAME=VALUE ...] [remove=true]", ReadExtension<2>},
    {"schedule",
     "schedule THREAD [period=TIME] [activation=period|free_running|trigger] [priority=N] [on_overrun=skip|catch_up]",
     ReadSchedule},
}};

Result<Change> ReadChange(const ChangeLine& line) {
  const ChangeArgument& first = line.front();
  const auto verb = std::ranges::find(kVerbs, first.text, &Verb::name);
  if (verb == kVerbs.end()) {
    return Error{.message = "there is no change '" + first.text + "'",
                 .position = first.position,
                 .hint = NearestNameHint(first.text, NamesOf(kVerbs, &Verb::name))};
  }
  Arguments arguments(line, verb->usage);
  Change change = verb->read(arguments);
  arguments.End();
  if (arguments.error()) return *arguments.error();
  return change;
}

}  // namespace

PlacedChanges ParseChanges(std::string_view text, const SourcePosition& begins, Diagnostics& diagnostics) {
  PlacedChanges placed;
  for (const ChangeLine& line : internal::SplitChanges(text, begins, diagnostics)) {
    auto change = ReadChange(line);
    if (!change) {
      diagnostics.Add(change.error());
      continue;
    }
    placed.changes.push_back(std::move(*change));
    placed.positions.push_back(line.front().position);
  }
  return placed;
}

}  // namespace runnel
