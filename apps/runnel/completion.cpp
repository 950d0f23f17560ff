#include <algorithm>
#include <functional>
#include <iostream>
#include <sstream>

#include "apps/runnel/commands.h"
#include "core/base/nearest_name.h"
#include "plugins/control/control_client.h"
#include "plugins/control/control_folder.h"

namespace runnel::program {

namespace {

using Candidates = std::vector<std::string>;

// One line of the answer to "paths".
struct Element {
  std::string kind;
  std::string path;
  bool is_interface = false;
};

std::vector<std::string> Lines(ControlClient& client, const std::string& request) {
  std::string text;
  const auto code = client.Ask(
      request,
      [&](std::string_view part) {
        text += part;
        return true;
      },
      [](std::string_view) { return true; });
  std::vector<std::string> lines;
  std::istringstream stream(code ? text : "");
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<Element> Elements(ControlClient& client) {
  std::vector<Element> elements;
  for (const std::string& line : Lines(client, "paths")) {
    std::istringstream parts(line);
    Element element;
    std::string interface;
    std::getline(parts, element.kind, '\t');
    std::getline(parts, element.path, '\t');
    element.is_interface = static_cast<bool>(std::getline(parts, interface, '\t'));
    elements.push_back(std::move(element));
  }
  return elements;
}

Candidates Paths(ControlClient& client, const std::function<bool(const Element&)>& fits) {
  Candidates paths;
  for (const Element& each : Elements(client)) {
    if (fits(each)) paths.push_back(each.path);
  }
  return paths;
}

Candidates Types(ControlClient& client) {
  return NamesOf(Lines(client, "types"),
                 [](const std::string& line) { return line.substr(0, line.find('\t')); });
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
bool Sends(const Element& each) { return each.kind == "output" || each.is_interface; }
bool Receives(const Element& each) { return each.kind == "input" || each.is_interface; }

// What can be the word number `place` (from 0) after the command.
Candidates Propose(ControlClient& client, const std::string& command, std::size_t place) {
  const bool is_first = place == 0;
  if (command == "ls" && is_first) return Paths(client, [](const Element&) { return true; });
  const bool is_of_port = command == "echo" || command == "hz" || command == "publish" || command == "release";
  if (is_of_port && is_first) return Paths(client, IsPort);
  if (command == "set" && is_first) return Paths(client, OfKind("parameter"));
  if ((command == "connect" || command == "disconnect") && place < 2) {
    return Paths(client, is_first ? Sends : Receives);
  }
  if (command == "delete" && is_first) {
    return Paths(client, [](const Element& each) { return IsPart(each) || each.is_interface; });
  }
  if (command == "swap" && is_first) return Paths(client, OfKind("module"));
  if (command == "create" && is_first) {
    Candidates groups = Paths(client, OfKind("group"));
    for (std::string& each : groups) each += '/';
    return groups;
  }
  if ((command == "create" || command == "swap") && place == 1) return Types(client);
  if (command == "record") return Paths(client, Sends);
  if (command == "speed" && is_first) return {"0", "0.5", "1", "2", "10"};
  if (command == "move") return is_first ? Paths(client, IsPart) : Threads(client);
  return {};
}

// The words that are no options; what follows an option that has a value is left out.
Candidates WithoutOptions(const Candidates& words, std::string& application) {
  static const Candidates kWithValue{"--app",       "-n", "--queue",  "--on-full",
                                     "--probation", "-o", "--output", "--compression", "--rate", "--deadline", "--convert"};
  Candidates plain;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::ranges::count(kWithValue, words[i]) > 0 && i + 1 < words.size()) {
      if (words[i] == "--app") application = words[i + 1];
      ++i;
    } else if (!words[i].starts_with('-')) {
      plain.push_back(words[i]);
    }
  }
  return plain;
}

Candidates FindCandidates(const Candidates& words, const std::vector<RunningApplication>& running) {
  if (words.size() > 1 && words[words.size() - 2] == "--app") {
    return NamesOf(running, [](const RunningApplication& each) { return each.hello.application; });
  }
  std::string application;
  const Candidates plain = WithoutOptions(words, application);
  if (plain.size() < 2) return {};
  const auto chosen = ChooseApplication(running, application);
  if (!chosen) return {};
  auto client = ControlClient::Connect(chosen->socket);
  return client ? Propose(*client, plain.front(), plain.size() - 2) : Candidates{};
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
