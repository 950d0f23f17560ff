#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <future>
#include <mutex>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/arena/bounds.h"
#include "apps/arena/matrix.h"
#include "apps/arena/names.h"
#include "core/base/file_descriptor.h"
#include "core/base/files.h"

namespace runnel::arena {

namespace {

// How a program has ended.
struct ProgramEnding {
  int exit_code = 0;
  int signal = 0;               // that ended it; 0: it ended by itself
  bool has_hung = false;        // it was ended because it took longer than it may
  double wall_time = 0.0;       // s
  double processor_time = 0.0;  // s
};

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLook{50};  // how often it is looked whether to stop

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Calls nothing that a child of a program with several threads may not call.
[[noreturn]] void BecomeTheProgram(const std::vector<char*>& words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);     // when the thread ends that has made it, which waits for it
  if (getppid() != parent) _exit(127);  // it has died meanwhile
  setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(words.front(), words.data());
  _exit(127);
}

// `descriptor` becomes readable when the process has ended. Whether it has until `end`, or was to stop.
bool WaitForEnd(int descriptor, Clock::time_point end, const std::atomic<bool>& is_to_stop) {
  pollfd polled{.fd = descriptor, .events = POLLIN, .revents = 0};
  while (!is_to_stop) {
    const auto left = std::chrono::ceil<milliseconds>(end - Clock::now());
    if (left <= milliseconds(0)) return false;
    if (poll(&polled, 1, static_cast<int>(std::min(left, kLook).count())) > 0) break;
  }
  return true;
}

// Runs a program beside this one, and waits for its end; ends it itself when it has taken `limit`, or when
// `is_to_stop` becomes true. `words`: the program's file and its arguments. What it writes goes to the
// file `output`. It is in a group of its own, so that Ctrl-C reaches only this program, and it dies
// with this program, however that ends.
//
// Threads: any, several at the same time. Errors: what the system says.
Result<ProgramEnding> RunProgram(const std::vector<std::string>& words, const std::filesystem::path& output,
                                 std::chrono::duration<double> limit, const std::atomic<bool>& is_to_stop) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const FileDescriptor file(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (!file.is_open()) return SystemError(output.string());
  const auto began = Clock::now();
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) BecomeTheProgram(pointers, file.number(), parent);
  if (process < 0) return SystemError("no process can be started");
  // By its number: the header of glibc 2.36 is not for C++.
  const FileDescriptor watched(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
  const Error unwatched = SystemError("a process cannot be watched");
  ProgramEnding ending;
  if (watched.is_open()) {
    const auto end = began + std::chrono::duration_cast<Clock::duration>(limit);
    ending.has_hung = !WaitForEnd(watched.number(), end, is_to_stop);
  }
  kill(process, SIGKILL);  // if it still runs; its number is its own until it has been waited for
  int status = 0;
  rusage usage{};
  while (wait4(process, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  if (!watched.is_open()) return unwatched;
  ending.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  ending.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  ending.wall_time = std::chrono::duration<double>(Clock::now() - began).count();
  ending.processor_time = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  return ending;
}

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

Result<RunRecord> MakeRun(const PlannedRun& run, const std::string& files, const RunContext& context) {
  const std::string application = files + ".xml", world = files + "_world.xml", result = files + ".json",
                    output = files + ".txt";
  const RunSettings& settings = context.arguments.settings;
  const Course& course = context.matrix.courses[run.course];
  if (auto written = WriteFile(application, run.application); !written) return written.error();
  // What has been judged is what is run, whatever becomes of the file meanwhile.
  if (auto written = WriteFile(world, course.text); !written) return written.error();
  const double wall_limit = context.arguments.wall_limit;
  const auto ending =
      RunProgram({context.product.program.string(), "run", application, "--fast", "--quiet", "--no-control",
                  "world=" + world, "first_direction=" + run.key.direction, "seed=" + std::to_string(run.key.seed),
                  fmt::format("noise={}", settings.noise), fmt::format("path_step={}", settings.path_step),
                  fmt::format("time_limit={}", settings.time_limit > 0.0 ? settings.time_limit : TimeLimitOf(course)),
                  fmt::format("safe_distance={}", settings.safe_distance), "result=" + result},
                 output, std::chrono::duration<double>(wall_limit), context.is_to_stop);
  if (!ending) return ending.error();
  RunRecord record{.key = run.key,
                   .wall_time = ending->wall_time,
                   .processor_time = ending->processor_time,
                   .noise = settings.noise};
  if (const auto& shortest = course.shortest) record.shortest_path = shortest->length;
  if (ending->has_hung || ending->signal != 0) {
    record.has_ended_by_itself = false;
    record.result.outcome = ending->has_hung ? "timeout" : "error";
    record.result.remark = ending->has_hung ? fmt::format("hung: ended after {} s of real time", wall_limit)
                                            : std::string("crashed: ") + strsignal(ending->signal);
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
