#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "apps/runnel/commands.h"
#include "apps/runnel/meant_application.h"
#include "apps/runnel/output.h"
#include "core/xml/xml_document.h"
#include "plugins/control/change_commands.h"
#include "plugins/control/control_client.h"
#include "plugins/control/control_folder.h"
#include "plugins/control/protocol.h"

namespace runnel::program {

namespace {

Result<std::string> ReadChanges(const std::string& file) {
  if (file == "-") return std::string(std::istreambuf_iterator<char>(std::cin), {});
  return XmlDocument::ReadText(file);
}

// Most often a variable of a shell that is not set: it must not become "all of them". Values may be empty texts; so may
// the thread of "move", which is that of the group then.
Result<void> RefuseEmptyWords(const ControlArguments& arguments) {
  const std::string& command = arguments.command;
  const bool has_value = command == "set" || command == "publish" || command == "call" || command == "move";
  const auto end = has_value && !arguments.words.empty() ? arguments.words.begin() + 1 : arguments.words.end();
  const bool is_empty = std::find(arguments.words.begin(), end, "") != end ||
                        std::ranges::any_of(arguments.options, [](const auto& each) { return each.second.empty(); });
  if (!is_empty) return {};
  return Error{.message = "'" + command + "': one of its words is empty",
               .hint = "is a variable of the shell not set?"};
}

Result<Request> RequestOf(const ControlArguments& arguments) {
  if (auto good = RefuseEmptyWords(arguments); !good) return good.error();
  std::string change = ChangeTextOf(arguments.command, arguments.words, arguments.options);
  if (!change.empty()) {
    Request request{.command = "change", .arguments = {}, .options = {}, .body = std::move(change)};
    if (arguments.options.contains("yes")) request.options["yes"] = "yes";
    return request;
  }
  Request request{.command = arguments.command, .arguments = {}, .options = arguments.options, .body = {}};
  if (arguments.command == "change") {
    const std::string& file = arguments.words[0];
    const auto text = ReadChanges(file);
    if (!text) return text.error();
    request.options["file"] = file == "-" ? "standard input" : file;
    request.body = *text;
    return request;
  }
  request.arguments = arguments.words;
  // The application may be at home in another folder.
  if (arguments.command == "save" && !request.arguments.empty()) {
    request.arguments[0] = std::filesystem::absolute(request.arguments[0]).string();
  }
  if (!request.Option("file").empty()) {
    request.options["file"] = std::filesystem::absolute(request.Option("file")).string();
  }
  return request;
}

Result<std::vector<RunningApplication>> FindThem() {
  std::vector<Error> silent;
  auto applications = FindRunningApplications(ControlFolder(), &silent);
  for (const Error& error : silent) PrintError(error);
  return applications;
}

ExitCode ListApplications() {
  const auto applications = FindThem();
  if (!applications) return Fail(applications.error());
  std::size_t states = 5;
  for (const RunningApplication& each : *applications) states = std::max(states, each.hello.state.size());
  std::cout << fmt::format("{:>8}  {:<20}  {:>12}  {:>12}  {:<{}}  {}\n", "process", "application", "running for",
                           "its time", "state", states, "file");
  for (const RunningApplication& each : *applications) {
    const Hello& hello = each.hello;
    std::cout << Coloured(
        fmt::format("{:>8}  {:<20}  {:>10.2f} s  {:>10.2f} s  {:<{}}  {}\n", hello.process, hello.application,
                    ToSeconds(hello.real), ToSeconds(hello.time), hello.state, states, hello.file),
        STDOUT_FILENO);
  }
  std::cout << std::flush;
  return ExitCode::kDone;
}

// "record bug_demo …" as well as "record --app bug_demo …": patterns of ports are no names of applications.
std::string TakeApplication(const std::vector<RunningApplication>& running, Request& request) {
  if (request.command != "record" || request.arguments.empty()) return {};
  const std::string first = request.arguments.front();
  const bool is_one = std::ranges::any_of(running, [&](const RunningApplication& each) {
    return each.hello.application == first || std::to_string(each.hello.process) == first;
  });
  if (!is_one) return {};
  request.arguments.erase(request.arguments.begin());
  return first;
}

std::atomic<bool> interrupted{false};

// The first Ctrl-C ends the recording, a second the program.
void HeedInterruptions() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

// Has a running application record, shows on a terminal how it goes, and says what there is when it has ended,
// also by Ctrl-C.
Result<int> AskToRecord(ControlClient& client, const Request& request) {
  HeedInterruptions();
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  std::string last;
  const auto go_on = [&] {
    if (interrupted) client.EndRequests();
    return true;
  };
  const auto code = client.Ask(
      request.ToText(),
      [&](std::string_view text) {
        last = text;
        if (is_terminal) {
          std::cout << "\r\x1b[K" << Coloured(text.substr(0, text.find('\n')), STDOUT_FILENO) << std::flush;
        }
        return go_on();
      },
      [&](std::string_view text) {
        std::cerr << (is_terminal ? "\n" : "") << Coloured(text, STDERR_FILENO) << std::flush;
        return go_on();
      });
  if (is_terminal) std::cout << "\r\x1b[K";
  if (code && *code == 0) std::cout << Coloured(last, STDOUT_FILENO) << std::flush;
  return code;
}

// Where somebody sits who can be asked.
bool IsMeant(const std::string& what) {
  std::cerr << Coloured(what, STDERR_FILENO) << "? [y/N] " << std::flush;
  std::string answer;
  return std::getline(std::cin, answer) && (answer == "y" || answer == "yes");
}

// "/bug_demo" of the application bug_demo.
bool IsWhole(std::string_view path, const std::string& application) {
  while (path.ends_with('/')) path.remove_suffix(1);
  if (path.starts_with('/')) path.remove_prefix(1);
  return path == application;
}

// Until it can be reached again, as it loads its file; so that the next command finds it.
void WaitForProcess(pid_t process) {
  constexpr auto kLongest = std::chrono::seconds(30);
  const auto until = std::chrono::steady_clock::now() + kLongest;
  while (kill(process, 0) == 0 && std::chrono::steady_clock::now() < until) {
    const auto running = FindRunningApplications(ControlFolder());
    const auto is_it = [&](const RunningApplication& each) { return each.hello.process == process; };
    if (running && std::ranges::any_of(*running, is_it)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// What each of them says of the network; those without one are passed over if another has one.
Result<int> AskAllForNetwork(const std::vector<RunningApplication>& applications, const Request& request) {
  std::string why;
  bool is_any = false;
  for (const RunningApplication& each : applications) {
    auto client = ControlClient::Connect(each.socket);
    if (!client) return client.error();
    const auto answer = AskForAll(*client, request.ToText());
    if (!answer) return answer.error();
    if (answer->code != 0) {
      why = answer->errors;
      continue;
    }
    std::cout << (is_any ? "\n" : "") << Coloured(answer->output, STDOUT_FILENO) << std::flush;
    is_any = true;
  }
  if (!is_any) std::cerr << Coloured(why, STDERR_FILENO) << std::flush;
  return static_cast<int>(is_any ? ExitCode::kDone : ExitCode::kBadInput);
}

Result<int> Ask(ControlArguments arguments, Request request) {
  const Time asked = SteadyClock().Now();  // an application that does not answer may keep up the search
  const auto applications = FindThem();
  if (!applications) return applications.error();
  std::string wanted = arguments.application;
  if (wanted.empty() && arguments.command == "network" && applications->size() > 1)
    return AskAllForNetwork(*applications, request);
  if (wanted.empty()) wanted = TakeApplication(*applications, request);
  if (wanted.empty()) {
    const std::vector<std::string> words = arguments.words;
    wanted = ApplicationByWords(*applications, arguments);
    const auto again = arguments.words != words ? RequestOf(arguments) : Result<Request>(request);
    if (!again) return again.error();
    request = *again;
  }
  const auto chosen = ChooseApplication(*applications, wanted);
  if (!chosen) return chosen.error();
  auto client = ControlClient::Connect(chosen->socket);
  if (!client) return client.error();
  client->SetAsked(asked);
  if (arguments.command == "delete" && IsWhole(arguments.words[0], chosen->hello.application) &&
      isatty(STDIN_FILENO) == 1 && !request.Has("yes")) {
    if (!IsMeant("delete the whole application /" + chosen->hello.application + " and end its run")) {
      return static_cast<int>(ExitCode::kBadInput);
    }
    request.options["yes"] = "yes";
  }
  if (arguments.command == "record") return AskToRecord(*client, request);
  // One table in the place of the other, where somebody looks on.
  const bool redraws = arguments.command == "top" && !arguments.options.contains("once") && isatty(STDOUT_FILENO) == 1;
  const auto show = [redraws](std::ostream& stream, int descriptor) {
    return [&stream, redraws, descriptor](std::string_view text) {
      stream << (redraws ? "\x1b[H\x1b[2J" : "") << Coloured(text, descriptor) << std::flush;
      return stream.good();
    };
  };
  const auto code = client->Ask(request.ToText(), show(std::cout, STDOUT_FILENO), show(std::cerr, STDERR_FILENO));
  const bool ends =
      code && *code == 0 && request.arguments.empty() && (request.command == "restart" || request.command == "quit");
  if (ends) client->WaitForEnd();
  if (ends && request.command == "restart") WaitForProcess(chosen->hello.process);
  return code;
}

}  // namespace

ExitCode Control(const ControlArguments& arguments) {
  if (arguments.command == "ps") return ListApplications();
  if (arguments.command == "stop") return Stop(arguments);
  if (arguments.command == "complete") return Complete(arguments);
  const auto request = RequestOf(arguments);
  if (!request) return Fail(request.error(), ExitCode::kBadInput);
  const auto code = Ask(arguments, *request);
  return code ? static_cast<ExitCode>(*code) : Fail(code.error());
}

}  // namespace runnel::program
