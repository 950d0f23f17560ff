#include "apps/arena/runner.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <list>
#include <sstream>
#include <string>
#include <system_error>

#include <poll.h>

#include "apps/arena/application_text.h"
#include "apps/arena/child_process.h"

namespace runnel::arena {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTick = std::chrono::milliseconds(200);

std::string NumberText(double number) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

/// The run's files and its process.
struct Underway {
  const PlannedRun* run;
  ChildProcess process;
  std::filesystem::path result;
  std::filesystem::path output;
  bool hangs = false;
};

// What the program wrote last, for people who want to know why it crashed.
std::string LastLine(const std::filesystem::path& file) {
  const auto text = ReadFile(file);
  if (!text) return {};
  std::istringstream lines(*text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

// The first complaint, or else the last line.
std::string Complaint(const std::filesystem::path& file) {
  const auto text = ReadFile(file);
  if (!text) return {};
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error: ") != std::string::npos) return line.substr(line.find("error: "));
  }
  return LastLine(file);
}

RunRecord RecordOf(const Underway& underway, const ChildProcess::Ending& ending,
                   double wall_limit) {
  const std::chrono::duration<double> wall = Clock::now() - underway.process.started_at();
  RunRecord record{
      .key = underway.run->key, .wall_time = wall.count(), .processor_time = ending.processor_time};
  if (underway.hangs) {
    record.has_ended_by_itself = false;
    record.result.outcome = "timeout";
    record.result.remark = "hung: ended after " + NumberText(wall_limit) + " s of real time";
    return record;
  }
  if (ending.signal != 0) {
    record.has_ended_by_itself = false;
    record.result.outcome = "error";
    record.result.remark = std::string("crashed: ") + strsignal(ending.signal);
    return record;
  }
  const auto text = ReadFile(underway.result);
  const auto result = text ? ParseRunResult(*text) : Result<RunResult>(text.error());
  if (result) record.result = *result;
  if (!result || (record.result.outcome == "error" && ending.exit_code != 0)) {
    record.result.outcome = "error";
    const std::string complaint = Complaint(underway.output);
    if (!complaint.empty()) record.result.remark = complaint;
    if (record.result.remark.empty()) {
      record.result.remark = "ended with exit code " + std::to_string(ending.exit_code);
    }
    record.has_ended_by_itself = result.has_value();
  }
  return record;
}

/// Of temporary files; removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = std::filesystem::temp_directory_path() / "runnel-arena-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), "no temporary folder " + name);
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What runs now.
class Pool {
 public:
  Pool(const ArenaArguments& arguments, const Product& product, const Matrix& matrix)
      : arguments_(arguments), product_(product), matrix_(matrix) {}

  std::size_t size() const { return underway_.size(); }

  Result<void> Start(const PlannedRun& run) {
    const std::string name = std::to_string(count_++);
    const auto application = folder_.path() / (name + ".xml");
    const auto result = folder_.path() / (name + ".json");
    const auto output = folder_.path() / (name + ".txt");
    if (auto written = WriteFile(application, run.application); !written) return written;
    const RunSettings& settings = arguments_.settings;
    auto process = ChildProcess::Start(
        {product_.program.string(), "run", application.string(), "--fast", "--quiet",
         "--no-control", "world=" + matrix_.courses[run.course].file.string(),
         "first_direction=" + run.key.direction, "seed=" + std::to_string(run.key.seed),
         "noise=" + NumberText(settings.noise), "path_step=" + NumberText(settings.path_step),
         "time_limit=" + NumberText(settings.time_limit),
         "safe_distance=" + NumberText(settings.safe_distance), "result=" + result.string()},
        output);
    if (!process) return process.error();
    underway_.push_back({&run, std::move(*process), result, output});
    return {};
  }

  /// Until one has ended, or hangs, or a tick is over, or a signal comes.
  void Wait() const {
    std::vector<pollfd> descriptors;
    auto until = Clock::now() + kTick;
    for (const Underway& each : underway_) {
      descriptors.push_back({.fd = each.process.descriptor(), .events = POLLIN, .revents = 0});
      until = std::min(until, Deadline(each));
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    poll(descriptors.data(), descriptors.size(), std::max(0, static_cast<int>(left)));
  }

  /// Hands those over that have ended, and ends those that hang.
  Result<void> Collect(const RunCallbacks& callbacks) {
    for (auto each = underway_.begin(); each != underway_.end();) {
      if (!each->hangs && Clock::now() >= Deadline(*each)) {
        each->hangs = true;
        each->process.Kill();
      }
      const auto ending = each->process.Look();
      if (!ending) {
        ++each;
        continue;
      }
      const RunRecord record = RecordOf(*each, *ending, arguments_.wall_limit);
      if (auto told = callbacks.finished(*each->run, record); !told) return told;
      each = underway_.erase(each);
    }
    return {};
  }

 private:
  Clock::time_point Deadline(const Underway& each) const {
    // Once killed it will end soon, which its descriptor tells.
    if (each.hangs) return Clock::now() + kTick;
    return each.process.started_at() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(arguments_.wall_limit));
  }

  const ArenaArguments& arguments_;
  const Product& product_;
  const Matrix& matrix_;
  const TemporaryFolder folder_;
  std::list<Underway> underway_;
  std::size_t count_ = 0;
};

}  // namespace

Result<void> MakeRuns(const std::vector<const PlannedRun*>& runs, const ArenaArguments& arguments,
                      const Product& product, const Matrix& matrix, const RunCallbacks& callbacks) {
  Pool pool(arguments, product, matrix);
  std::size_t next = 0;
  while ((next < runs.size() || pool.size() > 0) && !callbacks.is_to_stop()) {
    if (next < runs.size() && pool.size() < static_cast<std::size_t>(arguments.jobs)) {
      if (auto started = pool.Start(*runs[next++]); !started) return started;
      continue;
    }
    pool.Wait();
    if (auto collected = pool.Collect(callbacks); !collected) return collected;
    callbacks.tick();
  }
  return {};
}

}  // namespace runnel::arena
