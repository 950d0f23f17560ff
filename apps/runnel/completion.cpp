#include <algorithm>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>

#include "apps/runnel/commands.h"
#include "apps/runnel/control_command_line.h"
#include "apps/runnel/meant_application.h"
#include "core/base/nearest_name.h"
#include "plugins/control/change_commands.h"
#include "plugins/control/control_folder.h"
#include "plugins/structure/change_fields.h"

namespace runnel::program {

namespace {

using Candidates = std::vector<std::string>;

// One line of the answer to "paths".
struct Element {
  std::string kind;
  std::string path;
  bool is_interface = false;
  std::string type = {};
  std::string choices = {};     // values that have names, separated by blanks; of a service, what arguments look like
  std::string short_path = {};  // without the application and the group of ports, as far as that names it
};

std::vector<std::string> Lines(ControlClient& client, const std::string& request) {
  const auto answer = AskForAll(client, request);
  std::vector<std::string> lines;
  std::istringstream stream(answer ? answer->output : "");
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// "/robot/planner/twist" for "/bug_demo/robot/planner/output/twist", as all documents write them.
void Shorten(std::vector<Element>& elements, const std::string& application) {
  std::map<std::string, int> uses;
  for (Element& each : elements) {
    std::string& path = each.short_path = each.path;
    if (path.starts_with(application + "/")) path.erase(0, application.size());
    const std::size_t name = path.rfind('/');
    const std::size_t group = name == 0 || name == std::string::npos ? name : path.rfind('/', name - 1);
    const bool is_in_group = !each.type.empty() && !each.is_interface && group != std::string::npos && group != name;
    const std::string group_name = is_in_group ? path.substr(group + 1, name - group - 1) : "";
    if (group_name == "input" || group_name == "output" || group_name == "parameter") path.erase(group, name - group);
    ++uses[path];
  }
  for (Element& each : elements) {
    if (uses[each.short_path] > 1) each.short_path = each.path;
  }
}

std::vector<Element> Elements(ControlClient& client) {
  std::vector<Element> elements;
  for (const std::string& line : Lines(client, "paths")) {
    std::istringstream parts(line);
    Element element;
    std::string interface;
    for (std::string* const part : {&element.kind, &element.path, &interface, &element.type, &element.choices}) {
      std::getline(parts, *part, '\t');
    }
    element.is_interface = interface == "interface";
    elements.push_back(std::move(element));
  }
  Shorten(elements, "/" + client.hello().application);
  return elements;
}

std::optional<Element> FindElement(ControlClient& client, const std::string& path) {
  const std::vector<Element> elements = Elements(client);
  const auto is_it = [&](const Element& each) { return each.path == path || each.short_path == path; };
  const auto found = std::ranges::find_if(elements, is_it);
  return found != elements.end() ? std::optional(*found) : std::nullopt;
}

Candidates Paths(ControlClient& client, const std::function<bool(const Element&)>& fits) {
  Candidates paths;
  for (const Element& each : Elements(client)) {
    if (!fits(each)) continue;
    paths.push_back(each.short_path);
    if (each.path != each.short_path) paths.push_back(each.path);
  }
  return paths;
}

// The short ones, unless what has been typed can only be the beginning of a full one.
Candidates WithBeginning(const Candidates& candidates, const std::string& beginning, const std::string& application) {
  Candidates fitting;
  for (const std::string& each : candidates) {
    if (each.starts_with(beginning)) fitting.push_back(each);
  }
  const auto is_short = [&](const std::string& each) { return !each.starts_with(application + "/"); };
  const bool are_all_full = std::ranges::none_of(fitting, is_short);
  if (!are_all_full) std::erase_if(fitting, [&](const std::string& each) { return !is_short(each); });
  std::ranges::sort(fitting);
  fitting.erase(std::unique(fitting.begin(), fitting.end()), fitting.end());
  return fitting;
}

Candidates Types(ControlClient& client) {
  return NamesOf(Lines(client, "types"), [](const std::string& line) { return line.substr(0, line.find('\t')); });
}

auto OfKind(const char* kind) {
  return [kind](const Element& each) { return each.kind == kind; };
}

Candidates Threads(ControlClient& client) {
  Candidates names = Paths(client, OfKind("thread"));
  for (std::string& each : names) each = each.substr(each.find_last_of('/') + 1);
  return names;
}

bool IsPort(const Element& each) { return each.kind == "input" || each.kind == "output"; }
bool IsPart(const Element& each) { return each.kind == "module" || each.kind == "group"; }
bool IsService(const Element& each) { return each.kind == "output" && each.type.starts_with("service "); }
bool Sends(const Element& each) { return each.kind == "output" || each.is_interface; }
bool Receives(const Element& each) { return each.kind == "input" || each.is_interface; }

// The inputs that take what the output gives: those of its type, if there are any.
Candidates Takers(ControlClient& client, const std::string& from) {
  const auto output = FindElement(client, from);
  const Candidates same = Paths(client, [&](const Element& each) {
    return output && Receives(each) && each.type == output->type && each.path != output->path;
  });
  return same.empty() ? Paths(client, Receives) : same;
}

Candidates ValuesOf(ControlClient& client, const std::string& path) {
  const auto found = FindElement(client, path);
  std::istringstream words(found ? found->choices : "");
  return {std::istream_iterator<std::string>(words), {}};
}

// What the service takes, to be filled in: '{name: ""}'.
Candidates ArgumentsOf(ControlClient& client, const std::string& path) {
  const auto found = FindElement(client, path);
  const bool has_any = found && IsService(*found) && !found->choices.empty();
  return has_any ? Candidates{"'" + found->choices + "'"} : Candidates{};
}

// "step=" for each parameter of the module.
Candidates SettingsOf(ControlClient& client, const std::string& path) {
  const auto module = FindElement(client, path);
  Candidates names;
  for (const Element& each : Elements(client)) {
    if (!module || each.kind != "parameter" || !each.path.starts_with(module->path + "/")) continue;
    names.push_back(each.path.substr(each.path.rfind('/') + 1) + "=");
  }
  return names;
}

// What a word of a change can be; `words`: those before it.
Candidates ProposeForChange(ControlClient& client, const ChangeForm& form, const Candidates& words) {
  const std::size_t place = words.size() - (form.name.find('_') == std::string::npos ? 0 : 1);
  const bool takes_settings = form.fields.front().proposal == Proposal::kModule && place >= 2;
  if (takes_settings) return SettingsOf(client, words[0]);
  const bool is_word = place < form.fields.size() && !form.fields[place].is_option();
  static const std::map<Proposal, std::function<Candidates(ControlClient&, const Candidates&)>> kProposals{
      {Proposal::kPart, [](auto& c, auto&) { return Paths(c, IsPart); }},
      {Proposal::kModule, [](auto& c, auto&) { return Paths(c, OfKind("module")); }},
      {Proposal::kNewPath,
       [](auto& c, auto&) { return NamesOf(Paths(c, OfKind("group")), [](auto& each) { return each + '/'; }); }},
      {Proposal::kDeletable,
       [](auto& c, auto&) { return Paths(c, [](auto& each) { return IsPart(each) || each.is_interface; }); }},
      {Proposal::kSender, [](auto& c, auto&) { return Paths(c, Sends); }},
      {Proposal::kReceiver, [](auto& c, auto&) { return Paths(c, Receives); }},
      {Proposal::kParameter, [](auto& c, auto&) { return Paths(c, OfKind("parameter")); }},
      {Proposal::kValue, [](auto& c, auto& before) { return ValuesOf(c, before[0]); }},
      {Proposal::kThread, [](auto& c, auto&) { return Threads(c); }},
      {Proposal::kModuleType, [](auto& c, auto&) { return Types(c); }}};
  if (form.name == "connect" && place == 1) return Takers(client, words[0]);
  const auto found = kProposals.find(is_word ? form.fields[place].proposal : Proposal::kNothing);
  return found != kProposals.end() ? found->second(client, words) : Candidates{};
}

// Which elements can be the first word after some commands.
struct Meant {
  std::vector<std::string_view> commands;
  std::function<bool(const Element&)> fits;
};

// What can be the last word after the command.
Candidates Propose(ControlClient& client, const Candidates& plain) {
  const std::string& command = plain.front();
  const Candidates words(plain.begin() + 1, plain.end() - 1);
  if (const ChangeForm* const change = FindChangeCommand(command, words))
    return ProposeForChange(client, *change, words);
  if (command == "record") return Paths(client, Sends);
  if (command == "call" && words.size() == 1) return ArgumentsOf(client, words[0]);
  if (!words.empty()) return {};
  const std::vector<Meant> all{
      {{"ls"}, [](const Element&) { return true; }},
      {{"echo", "hz", "publish", "release", "block"}, IsPort},
      {{"call", "activities"}, IsService},
      {{"get"}, [](const Element& each) { return IsPort(each) || each.kind == "parameter"; }},
      {{"restart"}, IsPart},
      {{"pause", "resume"}, [](const Element& each) { return IsPart(each) || each.kind == "thread"; }}};
  for (const Meant& each : all) {
    if (std::ranges::count(each.commands, command) > 0) return Paths(client, each.fits);
  }
  return command == "speed" ? Candidates{"0", "0.5", "1", "2", "10"} : Candidates{};
}

// The words that are no options; what follows an option that has a value is left out.
Candidates WithoutOptions(const Candidates& words, std::string& application) {
  const Candidates with_value = OptionsWithValue();
  Candidates plain;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::ranges::count(with_value, words[i]) > 0 && i + 1 < words.size()) {
      if (words[i] == "--app") application = words[i + 1];
      ++i;
    } else if (!words[i].starts_with('-')) {
      plain.push_back(words[i]);
    }
  }
  return plain;
}

// The name of the application with which a path begins, if several are running.
std::string NameIn(const Candidates& words, const std::vector<RunningApplication>& running) {
  for (const RunningApplication& each : running) {
    const auto begins = [&](const std::string& word) { return word.starts_with("/" + each.hello.application + "/"); };
    if (running.size() > 1 && std::ranges::any_of(words, begins)) return each.hello.application;
  }
  return {};
}

Candidates FindCandidates(const Candidates& words, const std::vector<RunningApplication>& running) {
  if (words.size() > 1 && words[words.size() - 2] == "--app") {
    return NamesOf(running, [](const RunningApplication& each) { return each.hello.application; });
  }
  std::string application;
  const Candidates plain = WithoutOptions(words, application);
  if (plain.size() < 2) return {};
  const auto chosen = ChooseApplication(running, application.empty() ? NameIn(plain, running) : application);
  if (!chosen) {
    return NamesOf(running, [](const RunningApplication& each) { return "/" + each.hello.application + "/"; });
  }
  auto client = ControlClient::Connect(chosen->socket);
  if (!client) return {};
  return WithBeginning(Propose(*client, plain), plain.back(), "/" + chosen->hello.application);
}

}  // namespace

ExitCode Complete(const ControlArguments& arguments) {
  const auto running = FindRunningApplications(ControlFolder());
  if (!running || arguments.words.empty()) return ExitCode::kDone;
  for (const std::string& each : FindCandidates(arguments.words, *running)) {
    if (each.starts_with(arguments.words.back())) std::cout << each << '\n';
  }
  return ExitCode::kDone;
}

}  // namespace runnel::program
