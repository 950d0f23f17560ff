#include "apps/arena/runner.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <future>
#include <mutex>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "apps/arena/application_text.h"
#include "apps/arena/program_run.h"
#include "core/base/temporary_folder.h"

namespace runnel::arena {

namespace {

constexpr auto kTick = std::chrono::milliseconds(100);

// What the program has said, for people who want to know why it failed: the first complaint, or else
// the last line.
std::string Complaint(const std::filesystem::path& file) {
  const auto text = ReadFile(file);
  std::istringstream lines(text ? *text : "");
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find("error: ");
    if (at != std::string::npos) return line.substr(at);
    if (!line.empty()) last = line;
  }
  return last;
}

/// What every run needs to know.
struct RunContext {
  const ArenaArguments& arguments;
  const Product& product;
  const Matrix& matrix;
  std::atomic<bool> is_to_stop = false;
};

Result<RunRecord> MakeRun(const PlannedRun& run, const std::string& files,
                          const RunContext& context) {
  const std::string application = files + ".xml", result = files + ".json", output = files + ".txt";
  if (auto written = WriteFile(application, run.application); !written) return written.error();
  const RunSettings& settings = context.arguments.settings;
  const double wall_limit = context.arguments.wall_limit;
  const auto ending = RunProgram(
      {context.product.program.string(), "run", application, "--fast", "--quiet", "--no-control",
       "world=" + context.matrix.courses[run.course].file.string(),
       "first_direction=" + run.key.direction, "seed=" + std::to_string(run.key.seed),
       fmt::format("noise={}", settings.noise), fmt::format("path_step={}", settings.path_step),
       fmt::format("time_limit={}", settings.time_limit),
       fmt::format("safe_distance={}", settings.safe_distance), "result=" + result},
      output, std::chrono::duration<double>(wall_limit), context.is_to_stop);
  if (!ending) return ending.error();
  RunRecord record{
      .key = run.key, .wall_time = ending->wall_time, .processor_time = ending->processor_time};
  if (ending->has_hung) {
    record.has_ended_by_itself = false;
    record.result.outcome = "timeout";
    record.result.remark = fmt::format("hung: ended after {} s of real time", wall_limit);
    return record;
  }
  if (ending->signal != 0) {
    record.has_ended_by_itself = false;
    record.result.outcome = "error";
    record.result.remark = std::string("crashed: ") + strsignal(ending->signal);
    return record;
  }
  const auto text = ReadFile(result);
  const auto told = text ? ParseRunResult(*text) : Result<RunResult>(text.error());
  if (told) record.result = *told;
  if (!told || (record.result.outcome == "error" && ending->exit_code != 0)) {
    record.result.outcome = "error";
    const std::string complaint = Complaint(output);
    if (!complaint.empty()) record.result.remark = complaint;
    if (record.result.remark.empty()) {
      record.result.remark = "ended with exit code " + std::to_string(ending->exit_code);
    }
    record.has_ended_by_itself = told.has_value();
  }
  return record;
}

}  // namespace

Result<void> MakeRuns(const std::vector<const PlannedRun*>& runs, const ArenaArguments& arguments,
                      const Product& product, const Matrix& matrix, const RunCallbacks& callbacks) {
  const auto folder = TemporaryFolder::Make("arena");
  if (!folder) return folder.error();
  RunContext context{arguments, product, matrix};
  std::mutex mutex;  // of the two below, and of who calls back
  std::size_t next = 0;
  Result<void> outcome;
  const auto work = [&] {
    std::unique_lock lock(mutex);
    while (next < runs.size() && !context.is_to_stop) {
      const std::size_t number = next++;
      lock.unlock();
      const auto record = MakeRun(*runs[number], folder->path() / std::to_string(number), context);
      lock.lock();
      if (context.is_to_stop) return;
      auto told = record ? callbacks.finished(*runs[number], *record) : record.error();
      if (told) continue;
      outcome = told;
      context.is_to_stop = true;
    }
  };
  std::vector<std::future<void>> workers;
  const std::size_t jobs = std::min(runs.size(), static_cast<std::size_t>(arguments.jobs));
  while (workers.size() < jobs) workers.push_back(std::async(std::launch::async, work));
  for (const auto& worker : workers) {
    while (worker.wait_for(kTick) == std::future_status::timeout) {
      const std::lock_guard lock(mutex);
      callbacks.tick();
      if (callbacks.is_to_stop()) context.is_to_stop = true;
    }
  }
  for (auto& worker : workers) worker.get();
  return outcome;
}

}  // namespace runnel::arena
