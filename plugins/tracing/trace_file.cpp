#include "plugins/tracing/trace_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

constexpr std::size_t kAtOnce = 1 << 18;

void AppendPadded(std::uint64_t number, int digits, std::string& text) {
  char buffer[20];
  for (int i = digits; i-- > 0; number /= 10) buffer[i] = static_cast<char>('0' + number % 10);
  text.append(buffer, static_cast<std::size_t>(digits));
}

}  // namespace

Result<TraceFile> TraceFile::Create(const std::string& file, std::uint64_t most_bytes) {
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);  // less the user's mask
  if (descriptor < 0) {
    const bool lacks_folder = errno == ENOENT;
    return Error{.message = std::string("cannot be written: ") + std::strerror(errno),
                 .position = {file},
                 .hint = lacks_folder ? "make its folder first" : ""};
  }
  return TraceFile(file, descriptor, most_bytes);
}

TraceFile::TraceFile(std::string file, int descriptor, std::uint64_t most_bytes)
    : file_(std::move(file)),
      descriptor_(descriptor),
      most_bytes_(most_bytes),
      start_(SteadyClock().Now()),
      head_("\",\"pid\":" + std::to_string(getpid()) + ",\"tid\":") {}

TraceFile::TraceFile(TraceFile&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      most_bytes_(other.most_bytes_),
      start_(other.start_),
      head_(std::move(other.head_)),
      text_(std::move(other.text_)),
      events_in_text_(other.events_in_text_),
      reserve_(other.reserve_),
      written_(other.written_),
      events_(other.events_),
      left_out_(other.left_out_),
      error_(std::move(other.error_)) {}

TraceFile::~TraceFile() {
  if (descriptor_ >= 0) (void)Close();
}

bool TraceFile::Begin(char phase, int track, std::string_view name) {
  if (error_ || written_ + text_.size() + reserve_ > most_bytes_) {
    ++left_out_;
    return false;
  }
  // The comma comes first, so that the file is whole wherever it ends between two events.
  text_ += events_ == 0 ? "[\n{\"ph\":\"" : ",\n{\"ph\":\"";
  text_ += phase;
  text_ += head_;
  AppendJsonNumber(static_cast<std::int64_t>(track), text_);
  text_ += ",\"name\":";
  text_ += name;
  ++events_;
  ++events_in_text_;
  return true;
}

// In microseconds, as the format wants them.
void TraceFile::AppendTime(std::string_view key, Duration duration) {
  std::int64_t count = duration.count();
  text_ += key;
  if (count < 0) text_ += '-';
  const auto size = static_cast<std::uint64_t>(count < 0 ? -count : count);
  AppendJsonNumber(size / 1000, text_);
  text_ += '.';
  AppendPadded(size % 1000, 3, text_);
}

void TraceFile::End(std::string_view arguments) {
  if (!arguments.empty()) {
    text_ += ",\"args\":{";
    text_ += arguments;
    text_ += '}';
  }
  text_ += '}';
  if (text_.size() >= kAtOnce) Flush();
}

void TraceFile::AddName(int track, std::string_view what, std::string_view arguments) {
  if (Begin('M', track, what)) End(arguments);
}

void TraceFile::AddSlice(int track, std::string_view name, const char* category, Time began,
                         Time ended, std::string_view arguments) {
  if (!Begin('X', track, name)) return;
  text_ += ",\"cat\":\"";
  text_ += category;
  text_ += '"';
  AppendTime(",\"ts\":", began - start_);
  AppendTime(",\"dur\":", ended - began);
  End(arguments);
}

void TraceFile::AddInstant(int track, std::string_view name, const char* category, Time when,
                           std::string_view arguments) {
  if (!Begin('i', track, name)) return;
  text_ += ",\"s\":\"t\",\"cat\":\"";
  text_ += category;
  text_ += '"';
  AppendTime(",\"ts\":", when - start_);
  End(arguments);
}

void TraceFile::Flush() {
  Write(text_);
  if (error_) {
    events_ -= events_in_text_;
    left_out_ += events_in_text_;
  }
  text_.clear();
  events_in_text_ = 0;
}

void TraceFile::Write(std::string_view bytes) {
  while (!bytes.empty() && !error_) {
    const ssize_t count = write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      error_ =
          Error{.message = std::string("the trace could not be written: ") + std::strerror(errno),
                .position = {file_}};
      return;
    }
    written_ += static_cast<std::uint64_t>(count);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

Result<void> TraceFile::Close() {
  Flush();
  Write(events_ == 0 ? "[\n]\n" : "\n]\n");
  if (close(std::exchange(descriptor_, -1)) != 0 && !error_) {
    error_ =
        Error{.message = std::string("the trace could not be written: ") + std::strerror(errno),
              .position = {file_}};
  }
  if (error_) return *error_;
  return {};
}

}  // namespace runnel
