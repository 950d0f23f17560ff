#include "plugins/genom_templates/generated_files.h"

#include <map>
#include <string_view>
#include <utility>

#include "core/base/files.h"
#include "core/base/program_output.h"

namespace runnel::genom {

namespace {

namespace fs = std::filesystem;
using What = WrittenFile::What;

constexpr const char* kKeptFolder = ".generated";

struct Plan {
  WrittenFile written;
  std::string text;
};

// What becomes of the file, without writing it.
Plan PlanFor(const fs::path& folder, const GeneratedFile& file, WhatIsThere what_is_there, Diagnostics& diagnostics) {
  Plan plan{{.path = file.path}, file.text};
  const fs::path path = fs::path(file.path).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == ".." || *path.begin() == kKeptFolder) {
    diagnostics.Add(
        {.message = "a template cannot make '" + file.path + "'", .hint = "its files are within one folder"});
    return plan;
  }
  const auto before = TextOfFile(folder / file.path);
  if (!before) return plan;
  if (*before == file.text) {
    plan.written.what = What::kSame;
    return plan;
  }
  plan.written.what = What::kReplaced;
  if (!file.is_kept || what_is_there == WhatIsThere::kIsOverwritten) return plan;
  const auto base = TextOfFile(folder / kKeptFolder / file.path);
  if (!base && what_is_there == WhatIsThere::kIsAdopted) {
    plan.written.what = What::kSame;
    return plan;
  }
  if (!base) {
    diagnostics.Add({.message = "this file is there already, and was made by nothing that is known here",
                     .position = {(folder / file.path).string()},
                     .hint = "move it away, or have it adopted or overwritten"});
    return plan;
  }
  if (*base == *before) return plan;  // its user has changed nothing
  auto merged = Merge(*base, *before, file.text);
  if (!merged) {
    diagnostics.Add(merged.error().WithPosition({(folder / file.path).string()}));
    return plan;
  }
  plan.text = std::move(merged->text);
  plan.written.conflicts = merged->conflicts;
  plan.written.what = merged->conflicts > 0 ? What::kConflict : plan.text == *before ? What::kSame : What::kMerged;
  return plan;
}

bool WriteOne(const fs::path& file, const std::string& text, Diagnostics& diagnostics) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const auto written = ReplaceFile(file, text);
  if (!written) diagnostics.Add(written.error());
  return written.has_value();
}

int CountOf(std::string_view mark, std::string_view text) {
  int count = 0;
  for (auto at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + mark.size())) ++count;
  return count;
}

}  // namespace

std::vector<WrittenFile> WriteFiles(const fs::path& folder, const std::vector<GeneratedFile>& files,
                                    WhatIsThere what_is_there, Diagnostics& diagnostics) {
  std::vector<Plan> plans;
  for (const GeneratedFile& each : files) plans.push_back(PlanFor(folder, each, what_is_there, diagnostics));
  std::vector<WrittenFile> written;
  if (!diagnostics.ok()) return written;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const bool is_same = plans[i].written.what == What::kSame;
    if (!is_same && !WriteOne(folder / files[i].path, plans[i].text, diagnostics)) break;
    // Last, so that a file which could not be written is merged with the old one again.
    if (files[i].is_kept && TextOfFile(folder / kKeptFolder / files[i].path) != files[i].text &&
        !WriteOne(folder / kKeptFolder / files[i].path, files[i].text, diagnostics)) {
      break;
    }
    written.push_back(plans[i].written);
  }
  return written;
}

Result<Merged> Merge(const std::string& base, const std::string& mine, const std::string& made) {
  const auto folder = TemporaryFolder::Make("merge");
  if (!folder) return folder.error();
  const std::map<std::string, const std::string&> files{{"base", base}, {"mine", mine}, {"made", made}};
  for (const auto& [name, text] : files) {
    const bool is_whole = text.empty() || text.ends_with('\n');
    if (auto written = ReplaceFile(folder->path() / name, is_whole ? text : text + '\n'); !written)
      return written.error();
  }
  const auto merged = OutputOf({.words = {"diff3", "--text", "--merge", "--show-overlap", "--label=yours",
                                          "--label=base", "--label=template", "mine", "base", "made"},
                                .folder = folder->path()});
  const bool is_done = merged && (merged->exit_code == 0 || merged->exit_code == 1);  // 1: there are conflicts
  if (!is_done) {
    return Error{.message = "the program diff3 cannot merge what you have changed with what the template makes",
                 .hint = merged ? "" : "it is in the package diffutils"};
  }
  constexpr std::string_view kConflict = "<<<<<<< yours\n";
  return Merged{merged->text, CountOf(kConflict, merged->text) - CountOf(kConflict, mine)};
}

}  // namespace runnel::genom
