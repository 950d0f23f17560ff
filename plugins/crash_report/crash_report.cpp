#include "plugins/crash_report/crash_report.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#include <execinfo.h>
#include <fcntl.h>
#include <poll.h>
#include <ucontext.h>
#include <unistd.h>

#include "core/base/call_stack.h"
#include "core/base/check.h"
#include "core/base/signal_stack.h"
#include "plugins/scheduling/running_task.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RUNNEL_CRASHES_ARE_REPORTED 1
#else
#define RUNNEL_CRASHES_ARE_REPORTED 0
#endif

namespace runnel {

namespace {

/// A line that is put together where nothing may be allocated: what finds no room is cut off.
///
/// Threads: a value. May be used by the handler of a signal.
class CrashText {
 public:
  CrashText& operator<<(std::string_view text) noexcept;
  CrashText& operator<<(std::uint64_t number) noexcept { return Add(number, 10); }
  CrashText& Hexadecimal(std::uint64_t number) noexcept { return (*this << "0x").Add(number, 16); }

  [[nodiscard]] std::string_view text() const noexcept { return {bytes_.data(), size_}; }
  /// Writes it to a file descriptor; negative: nowhere.
  void WriteTo(int file) const noexcept;

 private:
  CrashText& Add(std::uint64_t number, unsigned base) noexcept;

  std::array<char, 1024> bytes_{};
  std::size_t size_ = 0;
};

CrashText& CrashText::operator<<(std::string_view text) noexcept {
  const std::size_t count = std::min(text.size(), bytes_.size() - size_);
  std::memcpy(bytes_.data() + size_, text.data(), count);
  size_ += count;
  return *this;
}

CrashText& CrashText::Add(std::uint64_t number, unsigned base) noexcept {
  std::array<char, 20> digits{};
  std::size_t first = digits.size();
  do {
    digits[--first] = "0123456789abcdef"[number % base];
    number /= base;
  } while (number > 0);
  return *this << std::string_view(digits.data() + first, digits.size() - first);
}

void CrashText::WriteTo(int file) const noexcept {
  if (file < 0) return;
  for (std::string_view left = text(); !left.empty();) {
    const ssize_t count = write(file, left.data(), left.size());
    if (count < 0 && errno != EINTR) return;
    left.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
  }
}

// Those that a program crashes by.
constexpr std::array kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::array kNames{"SIGSEGV", "SIGBUS", "SIGFPE", "SIGILL", "SIGABRT", "a signal"};

const char* SignalName(int signal) noexcept {
  return kNames[static_cast<std::size_t>(std::ranges::find(kSignals, signal) - kSignals.begin())];
}

// What stood in the way of going on.
const void* PlaceIn(const void* context) noexcept {
#if defined(__x86_64__)
  const auto& registers = static_cast<const ucontext_t*>(context)->uc_mcontext.gregs;
  return reinterpret_cast<const void*>(registers[REG_RIP]);
#elif defined(__aarch64__)
  return reinterpret_cast<const void*>(static_cast<const ucontext_t*>(context)->uc_mcontext.pc);
#else
  (void)context;
  return nullptr;
#endif
}

void WaitForByte(int pipe, int milliseconds) noexcept {
  pollfd readable{pipe, POLLIN, 0};
  (void)poll(&readable, 1, milliseconds);
}

}  // namespace

/// All that the handler needs, made before.
class CrashReport::Installed {
 public:
  explicit Installed(CrashReportOptions options) : options_(std::move(options)) {
    RUNNEL_CHECK(current.exchange(this) == nullptr, "one report of crashes at a time");
    (void)CallStack::Take();  // the first one loads what unwinds
    (void)pipe2(wake_.data(), O_CLOEXEC);
    (void)pipe2(done_.data(), O_CLOEXEC);
    rescuer_ = std::thread([this] { WaitAndRescue(); });
    struct sigaction action {};
    action.sa_sigaction = Handle;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], &action, &before_[i]);
    }
  }

  ~Installed() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], &before_[i], nullptr);
    }
    current = nullptr;
    close(wake_[1]);  // the rescuer reads its end
    rescuer_.join();
    for (const int each : {wake_[0], done_[0], done_[1]}) close(each);
  }

 private:
  static void Handle(int signal, siginfo_t* info, void* context) noexcept {
    if (Installed* const report = current.load()) report->Report(signal, *info, context);
    // Comes again when this returns, as what it is.
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    sigaction(signal, &action, nullptr);
    (void)raise(signal);
  }

  void Report(int signal, const siginfo_t& info, const void* context) noexcept {
    const std::thread::id self = std::this_thread::get_id();
    if (std::thread::id first; !crashed_.compare_exchange_strong(first, self)) {
      if (first == self) return;  // while it tells of its crash: it has told what it could
      // Another thread is about to tell of its own crash, and will end the process.
      if (self == rescuer_.get_id()) (void)write(done_[1], "!", 1);
      for (;;) WaitForByte(-1, 1000);
    }
    signal_ = signal;
    module_ = RunningModulePath();
    stack_ = CallStack::Take();
    if (const void* const place = PlaceIn(context)) stack_.KeepBetween(place, nullptr);
    if (!options_.file.empty()) {
      file_ = open(options_.file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
    }
    CrashText text;
    text << "\ncrash: " << (module_ != nullptr ? module_ : "no module, a thread outside of cycles") << ": "
         << SignalName(signal);
    if (signal != SIGABRT) {
      (text << " at address ").Hexadecimal(reinterpret_cast<std::uintptr_t>(info.si_addr));
    }
    text << "\n";
    for (const int file : {STDERR_FILENO, file_}) {
      text.WriteTo(file);
      if (file < 0) continue;
      const auto frames = stack_.frames();
      backtrace_symbols_fd(frames.data(), static_cast<int>(frames.size()), file);
    }
    (void)write(wake_[1], "!", 1);
    WaitForByte(done_[0], static_cast<int>(options_.patience / std::chrono::milliseconds(1)));
  }

  // Here all is allowed that threads may do, if nobody holds what it needs for ever.
  void WaitAndRescue() noexcept {
    char byte = 0;
    if (read(wake_[0], &byte, 1) != 1) return;
    try {
      const Crash crash{module_ != nullptr ? module_ : "", SignalName(signal_)};
      if (options_.rescue) options_.rescue(crash);
      WriteReadableStack();
    } catch (...) {
    }
    (void)write(done_[1], "!", 1);
  }

  void WriteReadableStack() const {
    std::string text = "with names and lines, as far as they are known:\n";
    for (const std::string& call : stack_.Texts()) text += "    " + call + "\n";
    if (file_ >= 0) text += "this is also in " + options_.file + "\n";
    for (const int file : {STDERR_FILENO, file_}) {
      if (file >= 0) (void)write(file, text.data(), text.size());
    }
  }

  static std::atomic<Installed*> current;

  const CrashReportOptions options_;
  const SignalStack stack_of_handler_;
  std::array<struct sigaction, kSignals.size()> before_{};
  std::array<int, 2> wake_{-1, -1};
  std::array<int, 2> done_{-1, -1};
  std::atomic<std::thread::id> crashed_{};  // nobody yet
  // Written by the handler before it wakes the rescuer.
  int signal_ = 0;
  const char* module_ = nullptr;
  CallStack stack_;
  int file_ = -1;
  std::thread rescuer_;
};

std::atomic<CrashReport::Installed*> CrashReport::Installed::current{nullptr};

CrashReport::CrashReport(CrashReportOptions options)
    : installed_(RUNNEL_CRASHES_ARE_REPORTED ? nullptr : std::make_unique<Installed>(std::move(options))) {}
CrashReport::~CrashReport() = default;

}  // namespace runnel
