#include "plugins/command_service/application_log.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <new>
#include <utility>

#include <fmt/chrono.h>

#include "core/base/characters.h"

namespace runnel {

namespace {

using EntryKind = ApplicationLog::Kind;

// In the order of their levels.
constexpr std::array kKindsByLevel{EntryKind::kDebug, EntryKind::kInfo, EntryKind::kWarning, EntryKind::kError,
                                   EntryKind::kError};

struct KindInfo {
  const char* name;
  LogLevel level;
};
// In the order of the kinds.
constexpr std::array<KindInfo, 6> kKinds{{{"fault", LogLevel::kError},
                                          {"warning", LogLevel::kWarning},
                                          {"change", LogLevel::kInfo},
                                          {"error", LogLevel::kError},
                                          {"info", LogLevel::kInfo},
                                          {"debug", LogLevel::kDebug}}};

const KindInfo& InfoOf(EntryKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

}  // namespace

// What has been done must be told as done, whatever the log does.
void ApplicationLog::Add(Kind kind, std::string text, std::string module, std::string cause) noexcept {
  try {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    Keep({0, std::chrono::system_clock::now(), clock_.Now() - start_, kind, Shortened(std::move(text), kLongestText),
          std::move(module), std::move(cause)});
  } catch (const std::bad_alloc&) {
  }
}

void ApplicationLog::Add(const LogMessage& message) noexcept {
  try {
    const Kind kind = kKindsByLevel[static_cast<std::size_t>(message.level)];
    Keep({0,
          std::chrono::system_clock::now(),
          message.time - start_,
          kind,
          Shortened(message.BodyText(), kLongestText),
          message.path,
          {}});
  } catch (const std::bad_alloc&) {
  }
}

void ApplicationLog::Keep(Entry entry) {
  const std::lock_guard lock(mutex_);
  if (entry.kind == Kind::kFault && !entry.module.empty()) ++faults_;
  entry.number = first_ + entries_.size();
  entries_.push_back(std::move(entry));
  if (entries_.size() <= kMostEntries) return;
  entries_.pop_front();
  ++first_;
}

ApplicationLog::Entries ApplicationLog::ReadEntries(std::uint64_t from, std::size_t most) const {
  Entries read;
  const std::lock_guard lock(mutex_);
  read.lost = from < first_ ? first_ - from : 0;
  const std::uint64_t begin = std::max(from, first_);
  const std::uint64_t end = first_ + entries_.size();
  for (read.next = begin; read.next < end && read.entries.size() < most; ++read.next) {
    read.entries.push_back(entries_[read.next - first_]);
  }
  return read;
}

std::uint64_t ApplicationLog::end() const {
  const std::lock_guard lock(mutex_);
  return first_ + entries_.size();
}

std::uint64_t ApplicationLog::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

const char* ApplicationLog::KindName(Kind kind) noexcept { return InfoOf(kind).name; }

// The path that a text begins with is told apart.
LogMessage ApplicationLog::MessageOf(const Entry& entry) const {
  const std::string prefix = entry.module + ": ";
  const bool has_prefix = !entry.module.empty() && entry.text.starts_with(prefix);
  return {.time = start_ + entry.time,
          .level = InfoOf(entry.kind).level,
          .path = entry.module,
          .text = has_prefix ? entry.text.substr(prefix.size()) : entry.text};
}

std::string ApplicationLog::LineOf(const Entry& entry) {
  const std::tm wall = fmt::localtime(std::chrono::system_clock::to_time_t(entry.wall));
  std::string line =
      fmt::format("{:%H:%M:%S} {:10.3f} s  {:<7}  {}", wall, ToSeconds(entry.time), KindName(entry.kind), entry.text);
  // What has more than one line goes on below its beginning.
  for (std::size_t at = line.find('\n'); at != std::string::npos; at = line.find('\n', at + 1)) {
    line.insert(at + 1, "    ");
  }
  return line;
}

}  // namespace runnel
