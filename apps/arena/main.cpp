#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>

#include "apps/arena/journal.h"
#include "apps/arena/names.h"
#include "apps/arena/progress.h"
#include "apps/arena/report.h"
#include "apps/program.h"

namespace runnel::arena {

namespace {

volatile std::sig_atomic_t stop_is_wanted = 0;

/// The first Ctrl-C ends the arena in order, a second one at once.
void HandleSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_is_wanted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

/// Before hours of runs, not after them.
Result<void> CheckOutputs(const ArenaArguments& arguments) {
  for (const std::string& file : {arguments.json, arguments.html}) {
    if (file.empty()) continue;
    const auto folder = std::filesystem::absolute(file).parent_path();
    if (std::filesystem::is_directory(file)) {
      return Error{.message = "there is a folder where the file shall be", .position = {file}};
    }
    if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file)) {
      return Error{.message = "is not a file that could be replaced", .position = {file}};
    }
    if (auto written = WriteFile(folder / ".runnel-arena", ""); !written) {
      return Error{.message = "the file cannot be written",
                   .position = {file},
                   .hint = "is its folder there, and may you write in it?"};
    }
    std::filesystem::remove(folder / ".runnel-arena");
  }
  std::error_code error;
  if (!arguments.svg.empty()) std::filesystem::create_directories(arguments.svg, error);
  if (error) {
    return Error{.message = "the folder cannot be made: " + error.message(), .position = {arguments.svg}};
  }
  return {};
}

class Session {
 public:
  Session(const ArenaArguments& arguments, const Product& product, const Matrix& matrix)
      : arguments_(arguments), product_(product), matrix_(matrix), records_(matrix.runs.size()) {}

  int Run() {
    if (auto opened = OpenJournal(); !opened) return Fail(opened.error());
    const auto to_do = RunsToDo();
    const auto ran = RunAll(to_do);
    const std::vector<RunRecord> finished = Finished();
    std::cout << TablesText(RowsOf(matrix_, finished), finished) << std::flush;
    const auto written = WriteOutputs(finished);
    if (!ran) Fail(ran.error(), exit_code::kRunFailed);
    if (!written) Fail(written.error(), exit_code::kRunFailed);
    TellOfTheRest(finished);
    const bool is_complete = finished.size() == matrix_.runs.size();
    return ran && written && is_complete && std::cout ? exit_code::kDone : exit_code::kRunFailed;
  }

 private:
  Result<void> OpenJournal() {
    if (arguments_.json.empty()) return {};
    const std::string file = arguments_.json + ".journal";
    const bool is_orphan = std::filesystem::exists(arguments_.json) && !std::filesystem::exists(file);
    if (arguments_.resume && is_orphan) {
      return Error{.message = "the runs in this file have no journal, " + file,
                   .position = {arguments_.json},
                   .hint = "give another file, or leave out --resume to make them all again"};
    }
    auto journal =
        arguments_.resume ? Journal::Resume(file, arguments_.settings) : Journal::Begin(file, arguments_.settings);
    if (!journal) return journal.error();
    journal_.emplace(std::move(*journal));
    return {};
  }

  std::vector<const PlannedRun*> RunsToDo() {
    std::vector<const PlannedRun*> to_do;
    for (std::size_t i = 0; i < matrix_.runs.size(); ++i) {
      const RunRecord* const record = arguments_.resume ? journal_->Find(matrix_.runs[i]) : nullptr;
      if (record != nullptr) {
        records_[i] = *record;
      } else {
        to_do.push_back(&matrix_.runs[i]);
      }
    }
    if (arguments_.resume && !arguments_.quiet) {
      std::cerr << matrix_.runs.size() - to_do.size() << " of " << matrix_.runs.size()
                << " runs are finished already\n";
    }
    return to_do;
  }

  Result<void> RunAll(const std::vector<const PlannedRun*>& to_do) {
    Progress progress(!arguments_.quiet, to_do.size(), static_cast<std::size_t>(arguments_.jobs));
    const auto finished = [&](const PlannedRun& run, const RunRecord& record) -> Result<void> {
      records_[static_cast<std::size_t>(&run - matrix_.runs.data())] = record;
      const std::string& remark = record.result.remark;
      // First what stays, so that what has been told is never lost.
      if (journal_) {
        if (auto added = journal_->Add(record, run.made_of); !added) return added;
      }
      progress.Finished(TextOf(record.key) + ": " + record.result.outcome + ", " + Fixed(record.result.path_length, 2) +
                        " m" + (remark.empty() ? "" : "; " + remark));
      return {};
    };
    return MakeRuns(
        to_do, arguments_, product_, matrix_,
        {.finished = finished, .tick = [&] { progress.Show(); }, .is_to_stop = [] { return stop_is_wanted != 0; }});
  }

  std::vector<RunRecord> Finished() const {
    std::vector<RunRecord> finished;
    for (const auto& record : records_) {
      if (record) finished.push_back(*record);
    }
    return finished;
  }

  // As many as can be written. The first error.
  Result<void> WriteOutputs(const std::vector<RunRecord>& finished) const {
    Result<void> done;
    const auto note = [&done](const Result<void>& written) {
      if (done) done = written;
    };
    if (!arguments_.json.empty()) note(WriteFile(arguments_.json, JsonOf(finished)));
    if (!arguments_.html.empty()) {
      note(WriteFile(arguments_.html, HtmlReport(matrix_, finished, arguments_.settings)));
    }
    if (arguments_.svg.empty()) return done;
    for (const RunRecord& record : finished) {
      const auto course = std::ranges::find(matrix_.courses, record.key.world, &Course::name);
      note(WritePicture(arguments_.svg, *course, record));
    }
    return done;
  }

  void TellOfTheRest(const std::vector<RunRecord>& finished) const {
    const auto failed = std::ranges::count(finished, false, &RunRecord::has_ended_by_itself);
    if (failed > 0) std::cerr << failed << " of the runs crashed or hung\n";
    if (finished.size() == matrix_.runs.size()) return;
    std::cerr << "interrupted: " << finished.size() << " of " << matrix_.runs.size() << " runs are finished";
    std::cerr << (journal_ ? "; --resume goes on from here\n" : "\n");
  }

  const ArenaArguments& arguments_;
  const Product& product_;
  const Matrix& matrix_;
  std::optional<Journal> journal_;
  std::vector<std::optional<RunRecord>> records_;  // of each run of the matrix
};

int RunArena(int count, const char* const* words) {
  if (count > 1 && std::string_view(words[1]) == "merge") return RunMerge(count - 1, words + 1);
  const auto arguments = ParseArguments(count, words);
  if (!arguments) {
    if (arguments.error().message.empty()) return exit_code::kDone;
    return Fail(arguments.error());
  }
  if (auto checked = CheckOutputs(*arguments); !checked) return Fail(checked.error());
  const Product product = FindProduct();
  Diagnostics diagnostics;
  const auto matrix = MakeMatrix(*arguments, product, diagnostics);
  if (!matrix) {
    std::cerr << diagnostics.ToString();
    return exit_code::kBadInput;
  }
  HandleSignals();
  return Session(*arguments, product, *matrix).Run();
}

}  // namespace

}  // namespace runnel::arena

int main(int count, char** words) {
  try {
    return runnel::arena::RunArena(count, words);
  } catch (...) {
    std::cerr << "error: " << runnel::DescribeException() << '\n';
    return runnel::exit_code::kRunFailed;
  }
}
