#include "apps/runnel/log_file.h"

namespace runnel::program {

void LogFile::Append(const ApplicationLog& log) {
  while (next_ < log.end()) {
    const ApplicationLog::Entries read = log.ReadEntries(next_, ApplicationLog::kMostEntries);
    if (read.lost > 0) stream_ << "(" << read.lost << " entries came too fast)\n";
    for (const auto& entry : read.entries) stream_ << ApplicationLog::LineOf(entry) << '\n';
    stream_.flush();
    next_ = read.next;
  }
}

std::optional<Error> LogFile::Failure() const {
  if (stream_) return {};
  Error error{.message = "the log cannot be written"};
  error.position.file = file_;
  return error;
}

}  // namespace runnel::program
