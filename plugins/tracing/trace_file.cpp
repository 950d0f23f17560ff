#include "plugins/tracing/trace_file.h"

#include <cerrno>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace runnel {

namespace {

constexpr std::size_t kAtOnce = 1 << 18;

// In microseconds, as the format wants them.
void AppendTime(std::string_view key, Duration duration, std::string& text) {
  const std::int64_t count = duration.count();
  const std::uint64_t size = count < 0 ? 0 - static_cast<std::uint64_t>(count) : static_cast<std::uint64_t>(count);
  fmt::format_to(std::back_inserter(text), ",\"{}\":{}{}.{:03}", key, count < 0 ? "-" : "", size / 1000, size % 1000);
}

}  // namespace

Result<TraceFile> TraceFile::Create(const std::string& file, std::uint64_t most_bytes) {
  std::FILE* const opened = std::fopen(file.c_str(), "we");  // closed in child processes
  if (opened == nullptr) {
    const bool lacks_folder = errno == ENOENT;
    Error error = SystemError("cannot be written", file);
    if (lacks_folder) error.hint = "make its folder first";
    return error;
  }
  std::setbuf(opened, nullptr);  // text_ is the buffer
  return TraceFile(file, opened, most_bytes);
}

TraceFile::TraceFile(std::string name, std::FILE* file, std::uint64_t most_bytes)
    : name_(std::move(name)),
      file_(file, std::fclose),
      most_bytes_(most_bytes),
      start_(SteadyClock().Now()),
      process_(getpid()) {}

TraceFile::~TraceFile() {
  if (file_ != nullptr) (void)Close();
}

bool TraceFile::Begin(char phase, int track, std::string_view name) {
  if (error_ || written_ + text_.size() + reserve_ > most_bytes_) {
    ++left_out_;
    return false;
  }
  // The comma comes first, so that the file is whole wherever it ends between two events.
  fmt::format_to(std::back_inserter(text_), R"({}{{"ph":"{}","pid":{},"tid":{},"name":{})",
                 events_ == 0 ? "[\n" : ",\n", phase, process_, track, name);
  ++events_;
  ++events_in_text_;
  return true;
}

void TraceFile::End(std::string_view arguments) {
  if (!arguments.empty()) {
    fmt::format_to(std::back_inserter(text_), ",\"args\":{{{}}}", arguments);
  }
  text_ += '}';
  if (text_.size() >= kAtOnce) Flush();
}

void TraceFile::AddName(int track, std::string_view what, std::string_view arguments) {
  if (Begin('M', track, what)) End(arguments);
}

void TraceFile::AddSlice(int track, std::string_view name, const char* category, Time began, Time ended,
                         std::string_view arguments) {
  if (!Begin('X', track, name)) return;
  fmt::format_to(std::back_inserter(text_), ",\"cat\":\"{}\"", category);
  AppendTime("ts", began - start_, text_);
  AppendTime("dur", ended - began, text_);
  End(arguments);
}

void TraceFile::AddInstant(int track, std::string_view name, const char* category, Time when,
                           std::string_view arguments) {
  if (!Begin('i', track, name)) return;
  fmt::format_to(std::back_inserter(text_), ",\"s\":\"t\",\"cat\":\"{}\"", category);
  AppendTime("ts", when - start_, text_);
  End(arguments);
}

void TraceFile::AddArrow(int track, std::string_view name, char phase, Time when, std::string_view id) {
  if (!Begin(phase, track, name)) return;
  fmt::format_to(std::back_inserter(text_), ",\"cat\":\"latency\",\"id\":\"{}\"{}", id,
                 phase == 's' ? "" : ",\"bp\":\"e\"");
  AppendTime("ts", when - start_, text_);
  End("");
}

void TraceFile::Flush() {
  const std::uint64_t before = written_;
  Write(text_);
  if (error_ && events_in_text_ > 0) {
    events_ -= events_in_text_;
    left_out_ += events_in_text_;
    // Half an event could not be read, and the bracket needs room.
    const auto end = static_cast<off_t>(before);
    if (fseeko(file_.get(), end, SEEK_SET) == 0) (void)ftruncate(fileno(file_.get()), end);
  }
  text_.clear();
  events_in_text_ = 0;
}

void TraceFile::Write(std::string_view bytes) {
  while (!bytes.empty() && !error_) {
    const std::size_t count = std::fwrite(bytes.data(), 1, bytes.size(), file_.get());
    written_ += count;
    bytes.remove_prefix(count);
    if (!bytes.empty() && errno != EINTR) Fail();
  }
}

Result<void> TraceFile::Close() {
  Flush();
  const std::string_view end = events_ == 0 ? "[\n]\n" : "\n]\n";
  if (std::fwrite(end.data(), 1, end.size(), file_.get()) != end.size() && !error_) Fail();
  if (std::fclose(file_.release()) != 0 && !error_) Fail();
  return error_ ? Result<void>(*error_) : Result<void>();
}

}  // namespace runnel
