#include "apps/arena/journal.h"

#include <array>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "apps/arena/names.h"

namespace runnel::arena {

namespace {

constexpr int kVersion = 1;

struct NamedSetting {
  const char* name;
  double RunSettings::*value;
};
constexpr std::array<NamedSetting, 4> kSettings{{{"noise", &RunSettings::noise},
                                                 {"path-step", &RunSettings::path_step},
                                                 {"time-limit", &RunSettings::time_limit},
                                                 {"safe-distance", &RunSettings::safe_distance}}};

std::string HeadOf(const RunSettings& settings) {
  nlohmann::ordered_json head{{"runnel_arena_journal", kVersion}};
  for (const auto& [name, value] : kSettings) head[name] = settings.*value;
  return head.dump();
}

Error ErrorIn(const std::filesystem::path& file, int line, const std::string& message, const std::string& hint) {
  return {.message = message, .position = {file.string(), line}, .hint = hint};
}

Result<void> CheckHead(const std::string& line, const RunSettings& settings, const std::filesystem::path& file) {
  const auto head = nlohmann::json::parse(line, nullptr, false);
  const auto number = [&head](const char* name) {
    const auto found = head.find(name);
    return found != head.end() && found->is_number() ? found->get<double>() : -1.0;
  };
  if (!head.is_object() || number("runnel_arena_journal") != kVersion) {
    return ErrorIn(file, 1, "this is not the journal of an arena", "remove it, or leave out --resume");
  }
  for (const auto& [name, value] : kSettings) {
    const double before = number(name);
    if (before == settings.*value) continue;
    std::ostringstream message;
    message << "the finished runs had --" << name << ' ' << before << ", not " << settings.*value;
    return ErrorIn(file, 1, message.str(), "give the same again, or leave out --resume");
  }
  return {};
}

}  // namespace

Result<void> ReadEntries(const std::filesystem::path& file, const std::string& text, const UseJournalEntry& use) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  for (int number = 2; std::getline(lines, line); ++number) {
    if (lines.eof() && !text.ends_with('\n')) break;
    const auto entry = ParseJournalLine(line);
    if (!entry) {
      return ErrorIn(file, number, "this line is broken: " + entry.error().message,
                     "remove it, and its run will be repeated");
    }
    if (auto used = use(*entry, line, number); !used) return used;
  }
  return {};
}

Result<Journal> Journal::Begin(const std::filesystem::path& file, const RunSettings& settings) {
  if (auto written = WriteFile(file, HeadOf(settings) + "\n"); !written) return written.error();
  return Journal(file);
}

Result<Journal> Journal::Resume(const std::filesystem::path& file, const RunSettings& settings) {
  if (!std::filesystem::exists(file)) return Begin(file, settings);
  const auto text = ReadFile(file);
  if (!text) return text.error();
  const std::string head = text->substr(0, text->find('\n'));
  if (auto checked = CheckHead(head, settings, file); !checked) return checked.error();
  Journal journal(file);
  std::string whole = head + "\n";
  const auto read =
      ReadEntries(file, *text, [&](const JournalEntry& entry, const std::string& line, int) -> Result<void> {
        journal.finished_.insert_or_assign(entry.record.key, entry);
        whole += line + "\n";
        return {};
      });
  if (!read) return read.error();
  if (whole.size() != text->size()) {
    if (auto written = WriteFile(file, whole); !written) return written.error();
  }
  return journal;
}

const RunRecord* Journal::Find(const PlannedRun& run) const {
  const auto found = finished_.find(run.key);
  if (found == finished_.end() || found->second.made_of != run.made_of) return nullptr;
  return found->second.record.has_ended_by_itself ? &found->second.record : nullptr;
}

Result<void> Journal::Add(const RunRecord& record, const std::string& made_of) {
  std::ofstream stream(file_, std::ios::binary | std::ios::app);
  stream << JournalLineOf(record, made_of) + "\n";
  stream.close();
  if (stream) return {};
  return Error{.message = "the journal cannot be written", .position = {file_.string()}};
}

}  // namespace runnel::arena
