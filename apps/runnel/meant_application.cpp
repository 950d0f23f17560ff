#include "apps/runnel/meant_application.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace runnel::program {

namespace {

// "/bug_demo/robot" is of the application bug_demo: the first word that begins with the name of one that runs.
std::string ApplicationInPaths(const std::vector<RunningApplication>& running, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (!word.starts_with('/')) continue;
    const std::string first = word.substr(1, word.find('/', 1) - 1);
    const auto is_called = [&](const RunningApplication& each) { return each.hello.application == first; };
    if (std::ranges::any_of(running, is_called)) return first;
  }
  return {};
}

// What `runnel network` says there; "" if it has none.
std::string NetworkTextOf(const RunningApplication& application) {
  auto client = ControlClient::Connect(application.socket);
  if (!client) return {};
  const auto answer = AskForAll(*client, "network");
  return answer && answer->code == 0 ? answer->output : "";
}

std::string ProcessOf(const RunningApplication& application) { return std::to_string(application.hello.process); }

}  // namespace

std::string ApplicationByWords(const std::vector<RunningApplication>& running, ControlArguments& arguments) {
  if (running.size() < 2) return {};
  if (const std::string named = ApplicationInPaths(running, arguments.words); !named.empty()) return named;
  const auto far =
      std::ranges::find_if(arguments.words, [](const std::string& word) { return word.starts_with("//"); });
  if (far == arguments.words.end()) return {};
  const std::string name = far->substr(2, far->find('/', 2) - 2);  // of "//robot/laser": "robot"
  const auto is_called = [&](const RunningApplication& each) { return each.hello.application == name; };
  if (arguments.command == "connect" || arguments.command == "disconnect") {
    if (running.size() > 2 || std::ranges::count_if(running, is_called) != 1) return {};
    return ProcessOf(*std::ranges::find_if_not(running, is_called));
  }
  if (std::ranges::any_of(running, is_called)) {
    far->erase(0, 1);  // it is there itself
    return name;
  }
  std::string found;
  for (const RunningApplication& each : running) {
    const std::string text = NetworkTextOf(each);
    if (text.find("member " + name + "\n") != std::string::npos) return ProcessOf(each);
    if (found.empty() && !text.empty()) found = ProcessOf(each);
  }
  return found;
}

Result<Answer> AskForAll(ControlClient& client, const std::string& request) {
  Answer answer;
  const auto keep_in = [](std::string& kept) {
    return [&kept](std::string_view more) {
      kept += more;
      return true;
    };
  };
  const auto code = client.Ask(request, keep_in(answer.output), keep_in(answer.errors));
  if (!code) return code.error();
  answer.code = *code;
  return answer;
}

namespace fs = std::filesystem;

std::string ApplicationFile(const std::string& word) {
  std::error_code error;
  const fs::path path(word);
  if (word.empty() || path.has_parent_path() || fs::exists(path, error)) return word;
  // Beside the program, in the build tree as where it is installed.
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  const fs::path shipped = folder / "share/runnel/xml/apps" / (path.stem().string() + ".xml");
  return fs::is_regular_file(shipped, error) ? shipped.string() : word;
}

}  // namespace runnel::program
