#include "plugins/model_checker/spin.h"

#include <fstream>
#include <sstream>

#include "core/base/files.h"
#include "core/base/program_output.h"

namespace runnel {

namespace {

constexpr const char* kModel = "model.pml";
constexpr int kTimeUp = 124;  // what `timeout` returns
constexpr int kNoSuchProgram = 127;

// `timeout`, of Debian's coreutils, ends all that Spin has started. If this process is ended meanwhile, by Ctrl-C or whatever
// else, `setpriv`, of util-linux, has the shell told, which ends that and takes the folder away.
constexpr const char* kWatched = R"(timeout "$@" & trap 'kill $!; wait; rm -rf "$PWD"; exit 1' HUP INT TERM; wait $!)";

ProgramOutput Run(const TemporaryFolder& folder, int limit, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"setpriv", "--pdeathsig",         "TERM", "sh", "-c", kWatched,
                                 "sh",      std::to_string(limit), "spin"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  auto output = OutputOf({.words = words, .folder = folder.path(), .keeps_complaints = true});
  return output ? *std::move(output) : ProgramOutput{.exit_code = kNoSuchProgram};
}

// What the model prints begins with "runnel ", which goes.
SpinAnswer ReadRun(const std::string& text) {
  constexpr std::string_view kMark = "runnel ";
  SpinAnswer answer;
  bool repeats = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("START OF CYCLE") != std::string::npos) {
      repeats = true;
      answer.repeats_from = answer.run.size();
    }
    const auto at = line.find(kMark);
    if (at != std::string::npos) answer.run.push_back(line.substr(at + kMark.size()));
  }
  if (!repeats) answer.repeats_from = answer.run.size();
  return answer;
}

bool Says(const ProgramOutput& ended, std::string_view text) { return ended.text.find(text) != std::string::npos; }

}  // namespace

Result<SpinAnswer> RunSpin(const std::string& model, const SpinSearch& search) {
  const auto folder = TemporaryFolder::Make("spin");
  if (!folder) return folder.error();
  std::ofstream(folder->path() / kModel) << model;
  std::vector<std::string> arguments = search.definitions;
  // Compiling well takes longer than what it saves.
  arguments.insert(arguments.end(), {"-run", "-O0", "-DMEMLIM=2000"});
  arguments.insert(arguments.end(), search.options.begin(), search.options.end());
  arguments.emplace_back(kModel);
  const ProgramOutput checked = Run(*folder, search.limit, arguments);
  if (checked.exit_code == kNoSuchProgram) {
    return Error{.message = "is not checked, for the model checker spin is not here",
                 .hint = "install the package spin"};
  }
  if (checked.exit_code == kTimeUp) {
    return Error{.message = "is not decided: the model checker took more than " + std::to_string(search.limit) + " s"};
  }
  if (!Says(checked, "errors: ")) {
    return Error{.message = "is not checked, for the model checker says: " + checked.text.substr(0, 300),
                 .hint = "it needs a C compiler (gcc)"};
  }
  if (Says(checked, "errors: 0")) {
    if (Says(checked, "max search depth too small") || Says(checked, "Search not completed")) {
      return Error{.message = "is not decided: the model checker could not look at everything"};
    }
    return SpinAnswer{.holds = true};
  }
  std::vector<std::string> replay = search.definitions;
  replay.insert(replay.end(), {"-t", "-T", "-B", kModel});
  return ReadRun(Run(*folder, search.limit, replay).text);
}

}  // namespace runnel
