#include <iostream>
#include <map>
#include <string>

#include "apps/arena/journal.h"
#include "apps/arena/names.h"
#include "apps/arena/run_record.h"
#include "apps/program.h"

namespace runnel::arena {

namespace {

struct MergedRun {
  JournalEntry entry;
  std::string line;
  std::filesystem::path from;
  int number = 0;
};
using MergedRuns = std::map<RunKey, MergedRun>;

struct Merged {
  std::string head;
  std::filesystem::path head_from;
  MergedRuns runs;
};

Result<void> Add(const RunKey& key, const MergedRun& run, Merged& merged) {
  const auto before = merged.runs.find(key);
  const bool is_there = before != merged.runs.end();
  if (is_there && before->second.entry.made_of != run.entry.made_of) {
    return Error{.message = "the run " + TextOf(key) + " was made of another world or application than in " +
                            before->second.from.string(),
                 .position = {run.from.string(), run.number},
                 .hint = "let one of the two run again"};
  }
  // One that crashed or hung gives way to one that did not.
  if (!is_there || run.entry.record.has_ended_by_itself) merged.runs.insert_or_assign(key, run);
  return {};
}

Result<void> AddPart(const std::filesystem::path& part, Merged& merged) {
  const std::filesystem::path journal = part.string() + ".journal";
  if (!std::filesystem::exists(journal)) {
    return Error{.message = "there is no journal of these runs, " + journal.string(),
                 .position = {part.string()},
                 .hint = "name the files that were given to --json"};
  }
  const auto text = ReadFile(journal);
  if (!text) return text.error();
  const std::string head = text->substr(0, text->find('\n'));
  if (merged.head.empty()) {
    merged.head = head;
    merged.head_from = journal;
  }
  if (head != merged.head || !head.starts_with("{\"runnel_arena_journal\"")) {
    return Error{.message = "the runs here had other settings than those of " + merged.head_from.string(),
                 .position = {journal.string(), 1},
                 .hint = "noise, path step, time limit and safe distance have to be the same"};
  }
  MergedRuns runs;  // the last line of each: --resume makes again what has crashed, or what it is made of has changed
  const auto read =
      ReadEntries(journal, *text, [&](const JournalEntry& entry, const std::string& line, int number) -> Result<void> {
        runs.insert_or_assign(entry.record.key, MergedRun{entry, line, journal, number});
        return {};
      });
  if (!read) return read;
  for (const auto& [key, run] : runs) {
    if (auto added = Add(key, run, merged); !added) return added;
  }
  return {};
}

}  // namespace

Result<std::size_t> Merge(const std::filesystem::path& into, const std::vector<std::filesystem::path>& parts) {
  Merged merged;
  // What it has already stays.
  if (std::filesystem::exists(into) || std::filesystem::exists(into.string() + ".journal")) {
    if (auto added = AddPart(into, merged); !added) return added.error();
  }
  for (const auto& part : parts) {
    if (auto added = AddPart(part, merged); !added) return added.error();
  }
  std::string journal = merged.head + "\n";
  std::vector<RunRecord> records;
  for (const auto& [key, run] : merged.runs) {
    journal += run.line + "\n";
    records.push_back(run.entry.record);
  }
  if (auto written = WriteFile(into.string() + ".journal", journal); !written) return written.error();
  if (auto written = WriteFile(into, JsonOf(records)); !written) return written.error();
  return records.size();
}

int RunMerge(int count, const char* const* words) {
  CLI::App program("Puts the runs of several arenas into one file.", "runnel arena merge");
  program.footer("Tables and pages of all of them: 'runnel arena ... --json INTO --resume' with the same words.");
  std::string into;
  std::vector<std::filesystem::path> parts;
  program.add_option("into", into, "the file that gets all runs, and its journal beside it")
      ->type_name("INTO.json")
      ->required();
  program.add_option("parts", parts, "what was given to --json")->type_name("PART.json")->required();
  return RunProgram(program, count, words, [&] {
    const auto merged = Merge(into, parts);
    if (!merged) return Fail(merged.error());
    std::cout << *merged << " runs in " << into << "\n";
    return exit_code::kDone;
  });
}

}  // namespace runnel::arena
